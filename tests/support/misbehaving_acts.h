// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/platform/helper.h"

/// A process that has been taken over calls the system by these. Each system has its own file.
namespace pellucid::test {

/// Whether this system confines processes; Wine gives every program the user's rights.
bool systemConfines();
/// A word that `attempt` or the decoder knows, and what the answer to it contains if the system
/// forbids it.
struct Forbidden {
    std::string word, answer;
};
std::vector<Forbidden> forbiddenActs();
/// Deletes the file `kept` and makes the file `pwned` in the current folder, among others. Does
/// what confinement forbids. *Returns* why it failed, or no error; nothing for another word.
std::optional<std::error_code> attempt(std::string_view word, const platform::HelpersEnds &ends);

/// Ends as a fault does.
[[noreturn]] void crash();
/// Ends as the system ends processes if memory runs out.
[[noreturn]] void beKilled();
/// Uses the processor without end, and sets back the clock that would end it.
[[noreturn]] void hang();
/// Uses the processor, not only of the program's own code.
void work();
/// Writes less than the head of a message.
void writeTooLittle(const platform::Channel &channel);

} // namespace pellucid::test
