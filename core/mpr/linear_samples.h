// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/volume/lattice.h"

namespace pellucid::mpr {

/// Points of a straight line through a volume, in samples. Few of them: places are single
/// precision, counted from the first.
struct SampleLine {
    static constexpr int mostPoints = 32;
    glm::dvec3 start, step;
    int count = 0; ///< at most mostPoints
};

/// Trilinear interpolation at the points of a line; a point outside takes the nearest one inside.
/// *Shape*: samples as in Volume; out: mostPoints, of which `count` are meant.
void linearSamples(const std::int16_t *samples, const volume::GridSize &size,
                   const SampleLine &line, float *out);
void linearSamples(const float *samples, const volume::GridSize &size, const SampleLine &line,
                   float *out);

} // namespace pellucid::mpr
