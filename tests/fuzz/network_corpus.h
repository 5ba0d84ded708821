// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace pellucid::fuzz {

/// As `writeCorpus`, for the targets of network_targets.h.
void writeNetworkCorpus(const std::string &target, const std::filesystem::path &folder);

} // namespace pellucid::fuzz
