// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/commands.h"

namespace pellucid::cli {

/// What the command asks for.
struct BatchOptions {
    std::string recipe, from, out, sendTo, shard;
    std::vector<std::string> paths, terms;
    int jobs = 2, threads = 0;
    std::uint64_t memory = 0;
    bool resumes = false, json = false;
};

/// Renders the studies by the recipe, and prints what was done. *Throws* Error{usage},
/// Error{unusable} if there is no study; Error{incomplete} if some failed or files are damaged;
/// Error{output}, Error{unreachable} for the servers; Cancelled.
void runBatch(const BatchOptions &options, const Context &context);

} // namespace pellucid::cli
