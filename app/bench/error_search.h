// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/classify/density_field.h"
#include "core/render/scene.h"

namespace pellucid::bench {

/// A field, a view and a tolerance, all made of numbers within 0..1, so that a search can move in
/// them: the kind of field, its lattice, its places and widths, the kind of view and its angles.
struct Candidate {
    std::vector<double> genes;
};

/// What a candidate stands for.
struct Trial {
    std::string name; ///< kind of field, size, view and tolerance
    classify::DensityField field;
    render::Scene scene;
};
/// Whole pictures without cue and light, of which the plan's error is a bound; or of any kind and
/// any part, beside each of which stands an error of its own.
enum class Asked { wholePicture, anyPicture };
Trial trialOf(const Candidate &candidate, Asked asked);

/// Predicted error of the plan and measured error of the image against the exact one. *Units*:
/// relative L2.
struct Verdict {
    double predicted = 0.0, measured = 0.0;
    double ofView = 0.0;        ///< what is said beside the picture itself
    bool keepsTolerance = true; ///< as the plan says
    double ratio() const {
        return predicted > 0.0 ? measured / predicted : measured > 0.0 ? 1e9 : 0;
    }
};
Verdict judge(const Trial &trial);

/// The error that stands beside a picture over the measured one.
struct PictureFactor {
    std::string name;
    double factor = 0.0;
};
/// Of random pictures of any kind whose tolerance is the usual one, the smallest factor first.
/// *Shape*: as many as were asked for.
std::vector<PictureFactor> picturePredictionFactors(int count, std::uint64_t seed);

struct SearchOptions {
    std::uint64_t seed = 1;
    double seconds = 60.0;      ///< it ends after so long,
    int trials = 1'000'000'000; ///< or after so many
};

struct SearchResult {
    int trials = 0;
    Candidate worst;
    Verdict verdict;
};

/// Looks for the candidate whose measured error is largest beside its prediction: random ones, the
/// best of which are changed a little, again and again. `found`: each that is worse than all
/// before.
SearchResult
searchCounterexample(const SearchOptions &options,
                     const std::function<void(const Trial &, const Verdict &)> &found = {});

} // namespace pellucid::bench
