// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace pellucid::fuzz {

/// Writes files that a target takes, generated each time: nothing that somebody else owns.
void writeCorpus(const std::string &target, const std::filesystem::path &folder);

} // namespace pellucid::fuzz
