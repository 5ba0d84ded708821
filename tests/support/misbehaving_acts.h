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
/// The words that `attempt` knows, and others that are forbidden here.
std::vector<std::string> forbiddenWords();
/// Does what confinement forbids. *Returns* why it failed, or no error; nothing for another word.
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
