// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/bench/error_trial.h"

namespace pellucid::bench {

/// The error predicted for a single picture, divided by the measured error.
struct PictureFactor {
    std::string name;
    double factor = 0.0;
};
/// The factors of random pictures of any kind at the default tolerance, in ascending order.
/// *Shape*: `count` entries.
std::vector<PictureFactor> picturePredictionFactors(int count, std::uint64_t seed,
                                                    PictureKind pictures);

struct SearchOptions {
    std::uint64_t seed = 1;
    double seconds = 60.0;      ///< the search ends after this time
    int trials = 1'000'000'000; ///< or after this many trials
};

struct SearchResult {
    int trials = 0;
    Candidate worst;
    Verdict verdict;
};

/// Searches for the candidate with the largest ratio of measured to predicted error. It starts from
/// random candidates and repeatedly changes the best ones a little. It calls `found` for each
/// candidate that is worse than all earlier ones.
SearchResult
searchCounterexample(const SearchOptions &options,
                     const std::function<void(const Trial &, const Verdict &)> &found = {});

} // namespace pellucid::bench
