// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confined/helper.h"

#include <chrono>
#include <cstdlib>

#include "core/files/user_folders.h"
#include "core/platform/process.h"

namespace pellucid::confined {

bool waitForPacket(const platform::Channel &channel, double seconds,
                   const task::Progress &progress) {
    using Clock = std::chrono::steady_clock;
    constexpr int cancelPollMs = 20; // the longest wait after a cancel
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(seconds));
    for (;;) {
        progress.check();
        if (channel.awaitPacket(cancelPollMs))
            return true;
        if (Clock::now() > end)
            return false;
    }
}

std::filesystem::path findProgram(const char *name, const char *variable) {
    namespace fs = std::filesystem;
    if (const char *const named = std::getenv(variable))
        return named;
    const fs::path own = files::programFolder(),
                   file = name + platform::programFile().extension().string();
    std::error_code ignored;
    for (const char *const place : {".", "../libexec/pellucid", "../lib/pellucid", "../bin"})
        if (const fs::path program = own / place / file; fs::exists(program, ignored))
            return program;
    return own / file; // reported as missing when it is needed
}

} // namespace pellucid::confined
