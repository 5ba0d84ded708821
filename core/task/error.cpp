// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/error.h"

#include <new>
#include <string_view>
#include <system_error>

namespace pellucid::task {

Error::Error(ErrorCode code, Reason reason, std::filesystem::path path)
    : std::runtime_error(path.empty() ? reason.english() : path.string() + ": " + reason.english()),
      m_code(code), m_reason(std::move(reason)), m_path(std::move(path)) {}

bool isLackOfMemory(const std::exception &error) {
    if (const auto *const known = dynamic_cast<const std::system_error *>(&error))
        return known->code() == std::errc::resource_unavailable_try_again ||
               known->code() == std::errc::not_enough_memory;
    return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
           std::string_view(error.what()).starts_with("pthread_create has failed");
}

} // namespace pellucid::task
