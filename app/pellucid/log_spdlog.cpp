// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pellucid/log_spdlog.h"

#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/spdlog.h>

#include "core/system/log.h"

namespace pellucid {

namespace {

constexpr std::size_t maxBytes = std::size_t(1) << 20;
constexpr std::size_t previousFiles = 1;

} // namespace

void keepLogIn(const std::filesystem::path &file) {
    try {
        const auto logger =
            spdlog::rotating_logger_mt("pellucid", file.string(), maxBytes, previousFiles);
        logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %v");
        logger->flush_on(spdlog::level::info);
        logger->set_error_handler([](const std::string &) {});
        system::setLogSink([logger](const std::string &line) { logger->info("{}", line); });
    } catch (const spdlog::spdlog_ex &) {
        // The folder does not exist or is not writable: there is no log.
    }
}

} // namespace pellucid
