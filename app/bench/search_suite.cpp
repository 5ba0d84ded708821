// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include <fmt/format.h>

#include "app/bench/error_search.h"
#include "app/bench/suites.h"

namespace pellucid::bench {

void runSearchSuite(const Report &report, double minutes, std::uint64_t seed) {
    const auto row = [&](const std::string &name, const Verdict &verdict, const std::string &note) {
        Row one;
        one.suite = "search";
        one.name = name;
        one.predictedError = verdict.predicted;
        one.relativeL2 = verdict.measured;
        one.note = note;
        report(one);
    };
    const SearchResult result = searchCounterexample(
        {.seed = seed, .seconds = 60.0 * minutes}, [&](const Trial &trial, const Verdict &verdict) {
            row(trial.name, verdict,
                fmt::format("measured {:.3f} of the prediction", verdict.ratio()));
        });
    row(trialOf(result.worst, PictureKind::whole).name, result.verdict,
        fmt::format("the worst of {} trials, seed {}: measured {:.3f} of the prediction",
                    result.trials, seed, result.verdict.ratio()));
}

void runPicturesSuite(const Report &report, int pictures, std::uint64_t seed) {
    const std::vector<PictureFactor> factors = picturePredictionFactors(pictures, seed);
    const auto at = [&](const char *what, std::size_t n) {
        Row row;
        row.suite = "pictures";
        row.name = factors[n].name;
        row.note = fmt::format("{} of {}: the prediction is {:.3f} times the measured error", what,
                               factors.size(), factors[n].factor);
        report(row);
    };
    at("the smallest", 0);
    at("the median", factors.size() / 2);
    at("95 % are below", (factors.size() - 1) * 95 / 100);
    at("the largest", factors.size() - 1);
}

} // namespace pellucid::bench
