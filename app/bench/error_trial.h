// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/classify/density_field.h"
#include "core/error/stated_error.h"
#include "core/scene/scene.h"

namespace pellucid::bench {

/// A field, a view and a tolerance, encoded as numbers in 0..1 so that a search can vary them: the
/// kind of field, its lattice, positions and widths, the kind of view and its angles.
struct Candidate {
    static constexpr std::size_t geneCount = 48;
    std::vector<double> genes;
};

/// A decoded candidate: a field, and a scene with view and tolerance.
struct Trial {
    std::string fieldName; ///< kind of field and size
    std::string name;      ///< also view, pixel and tolerance
    classify::DensityField field;
    scene::Scene scene;
};
/// The pictures to search. `whole`: uncropped, without cue and light; the plan's error bounds each
/// of them. Half of these are uniform: their plans state what they predict, where others state the
/// tolerance. `any`: any cue, light and crop; each picture has its own predicted error.
/// `amplified`: the same with amplified detail.
enum class PictureKind { whole, any, amplified };
/// The field and the scene that the genes encode.
Trial trialOf(const Candidate &candidate, PictureKind pictures);

/// The error that the plan predicts and the error of the image, measured against the exact image.
/// *Units*: relative L2.
struct Verdict {
    double predicted = 0.0, measured = 0.0;
    error::StatedError stated;  ///< measured, as the program does
    bool keepsTolerance = true; ///< according to the plan
    double ratio() const {
        return predicted > 0.0 ? measured / predicted : measured > 0.0 ? 1e9 : 0;
    }
};
/// Renders the trial, and the exact image.
Verdict judge(const Trial &trial);

} // namespace pellucid::bench
