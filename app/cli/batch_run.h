// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "core/archive/search.h"

namespace pellucid::cli {

/// Part `index`, from 0, of `count` parts of a batch.
struct Shard {
    int index = 0, count = 1;
};

/// The options of the command.
struct BatchOptions {
    std::string recipe, from, out, sendTo;
    std::vector<std::string> paths;
    archive::SearchTerms terms;
    Shard shard;
    int jobs = 2, threads = 0;
    std::uint64_t memory = 0;
    bool resumes = false, json = false, allowsUnprotected = false;
};

/// Renders the studies by the recipe, and prints what was done. *Throws* Error{usage},
/// Error{unusable} if the paths contain no study, or the server has not the one that is named;
/// Error{incomplete} if some failed or files are damaged; Error{output}, Error{unreachable} for the
/// servers; Cancelled.
void runBatch(const BatchOptions &options, const Context &context);

} // namespace pellucid::cli
