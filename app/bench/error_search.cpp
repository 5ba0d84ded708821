// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/error_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

namespace pellucid::bench {

std::vector<PictureFactor> picturePredictionFactors(int count, std::uint64_t seed,
                                                    PictureKind pictures) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<PictureFactor> factors;
    while (int(factors.size()) < count) {
        Candidate candidate;
        for (std::size_t n = 0; n < Candidate::geneCount; ++n)
            candidate.genes.push_back(uniform(random));
        candidate.genes[1] = 0.3; // the default tolerance, 1.1e-3
        const Trial trial = trialOf(candidate, pictures);
        const Verdict verdict = judge(trial);
        if (verdict.measured > 0.0)
            factors.push_back({trial.name, verdict.stated.high / verdict.measured});
    }
    std::sort(factors.begin(), factors.end(),
              [](const auto &a, const auto &b) { return a.factor < b.factor; });
    return factors;
}

SearchResult
searchCounterexample(const SearchOptions &options,
                     const std::function<void(const Trial &, const Verdict &)> &found) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::normal_distribution<double> normal(0.0, 1.0);
    // Several islands keep the best candidate of one kind of field from displacing the others.
    struct Island {
        Candidate best;
        double ratio = -1.0;
        int failures = 0;
    };
    std::array<Island, 8> islands;
    SearchResult result;
    double worst = -1.0;
    while (result.trials < options.trials && Clock::now() < end) {
        Island &island = islands[std::size_t(result.trials) % islands.size()];
        Candidate candidate = island.best;
        constexpr int patience = 60;
        const bool isNew = island.ratio < 0.0 || island.failures > patience;
        if (isNew) {
            candidate.genes.assign(Candidate::geneCount, 0.0);
            for (double &gene : candidate.genes)
                gene = uniform(random);
        } else {
            for (double &gene : candidate.genes)
                if (uniform(random) < 0.15)
                    gene = uniform(random) < 0.2
                               ? uniform(random)
                               : std::clamp(gene + 0.1 * normal(random), 0.0, 0.999999);
        }
        const Trial trial = trialOf(candidate, PictureKind::whole);
        const Verdict verdict = judge(trial);
        ++result.trials;
        ++island.failures;
        if (isNew || verdict.ratio() > island.ratio)
            island = {candidate, verdict.ratio(), 0};
        if (verdict.ratio() > worst) {
            worst = verdict.ratio();
            result.worst = candidate;
            result.verdict = verdict;
            if (found)
                found(trial, verdict);
        }
    }
    return result;
}

} // namespace pellucid::bench
