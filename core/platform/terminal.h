// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stop_token>
#include <string>

namespace pellucid::platform {

/// The answer to a question whose answer is not shown while it is typed.
struct HiddenAnswer {
    bool isAsked = false;            ///< there is a terminal
    std::optional<std::string> line; ///< none if the program was stopped before
};
HiddenAnswer askHidden(const std::string &question, const std::stop_token &stop);

/// Connects a program with windows to the terminal that started it, on systems that do not do so
/// themselves.
void joinTerminal();

/// Ends the program without waiting for anything, but with a terminal that shows what is typed.
[[noreturn]] void endAtOnce(int code);

} // namespace pellucid::platform
