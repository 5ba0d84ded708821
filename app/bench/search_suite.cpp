// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "app/bench/error_search.h"
#include "app/bench/error_sweep.h"
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
    for (const PictureKind kind : {PictureKind::any, PictureKind::amplified}) {
        const auto factors = picturePredictionFactors(pictures, seed, kind);
        const std::string with = kind == PictureKind::any ? "" : "with amplified detail, ";
        const auto at = [&](const char *what, std::size_t n) {
            Row row;
            row.suite = "pictures";
            row.name = factors[n].name;
            row.note = fmt::format("{}{} of {}: the prediction is {:.3f} times the measured error",
                                   with, what, factors.size(), factors[n].factor);
            report(row);
        };
        at("the smallest", 0);
        at("the median", factors.size() / 2);
        at("95 % are below", (factors.size() - 1) * 95 / 100);
        at("the largest", factors.size() - 1);
    }
}

void runSweepSuite(const Report &report, int fields, std::uint64_t seed) {
    struct Tolerance {
        int pictures = 0, missed = 0;
        double worst = 0.0, leastPlanned = std::numeric_limits<double>::infinity();
        std::vector<double> stated; // over the measured
    };
    std::map<double, Tolerance, std::greater<>> tolerances;
    const auto row = [](const std::string &name, const std::string &note) {
        Row one;
        one.suite = "sweep";
        one.name = name;
        one.note = note;
        return one;
    };
    const auto reportPicture = [&](const SweptPicture &picture, const std::string &note) {
        Row one = row(picture.name, note);
        one.predictedError = picture.stated.high;
        one.relativeL2 = picture.measured;
        report(one);
    };
    sweep(fields, seed, [&](const SweptPicture &picture) {
        Tolerance &at = tolerances[picture.tolerance];
        ++at.pictures;
        if (picture.planned > picture.tolerance)
            ++at.missed;
        else
            at.worst = std::max(at.worst, picture.measured / picture.tolerance);
        if (picture.measured > 0.0) {
            at.leastPlanned = std::min(at.leastPlanned, picture.planned / picture.measured);
            at.stated.push_back(picture.stated.high / picture.measured);
        }
        if (picture.measured > 1.1 * picture.stated.high)
            reportPicture(picture, "the stated error is too low");
        if (picture.measured > picture.planned)
            reportPicture(picture, "the plan's bound is too low");
    });
    for (auto &entry : tolerances) {
        const double tolerance = entry.first;
        Tolerance &at = entry.second;
        if (at.stated.empty())
            continue;
        std::sort(at.stated.begin(), at.stated.end());
        const auto share = [&](double part) {
            return at.stated[std::size_t(part * double(at.stated.size() - 1))];
        };
        report(row(fmt::format("tolerance {:.2g}", tolerance),
                   fmt::format(
                       "{} pictures, {} of them by plans that miss the tolerance; largest measured "
                       "error {:.2f} times the tolerance; stated over measured error: minimum "
                       "{:.2f}, median {:.2f}, 95th percentile {:.2f}, maximum {:.1f}; plan's "
                       "bound over measured error: minimum {:.2f}",
                       at.pictures, at.missed, at.worst, share(0.0), share(0.5), share(0.95),
                       share(1.0), at.leastPlanned)));
    }
}

} // namespace pellucid::bench
