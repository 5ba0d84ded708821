// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/classify/density_field.h"
#include "core/scene/scene.h"

namespace pellucid::bench {

/// A field, a view and a tolerance, encoded as numbers in 0..1 so that a search can vary them: the
/// kind of field, its lattice, positions and widths, the kind of view and its angles.
struct Candidate {
    std::vector<double> genes;
};

/// A decoded candidate: a field, and a scene with view and tolerance.
struct Trial {
    std::string name; ///< kind of field, size, view and tolerance
    classify::DensityField field;
    scene::Scene scene;
};
/// The pictures to search. `wholePicture`: uncropped, without cue and light; the plan's error
/// bounds each of them. `anyPicture`: any cue, light and crop; each picture has its own predicted
/// error.
enum class Asked { wholePicture, anyPicture };
Trial trialOf(const Candidate &candidate, Asked asked);

/// The error that the plan predicts and the error of the image, measured against the exact image.
/// *Units*: relative L2.
struct Verdict {
    double predicted = 0.0, measured = 0.0;
    double ofView = 0.0;        ///< the prediction for this picture alone
    bool keepsTolerance = true; ///< according to the plan
    double ratio() const {
        return predicted > 0.0 ? measured / predicted : measured > 0.0 ? 1e9 : 0;
    }
};
Verdict judge(const Trial &trial);

/// The error predicted for a single picture, divided by the measured error.
struct PictureFactor {
    std::string name;
    double factor = 0.0;
};
/// The factors of random pictures of any kind at the default tolerance, in ascending order.
/// *Shape*: `count` entries.
std::vector<PictureFactor> picturePredictionFactors(int count, std::uint64_t seed);

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
