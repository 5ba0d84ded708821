// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/volume/lattice.h"

namespace pellucid::mpr {

/// Points on a straight line through a volume, in samples. Their number is limited, because
/// positions are in single precision relative to the first.
struct SampleLine {
    static constexpr int maxPoints = 32;
    glm::dvec3 start, step;
    int count = 0; ///< at most maxPoints
};

/// Trilinear interpolation at the points of a line; points outside are clamped to the volume.
/// *Shape*: samples as in Volume; out: maxPoints, of which the first `count` are valid.
void linearSamples(const std::int16_t *samples, const volume::GridSize &size,
                   const SampleLine &line, float *out);
void linearSamples(const float *samples, const volume::GridSize &size, const SampleLine &line,
                   float *out);

} // namespace pellucid::mpr
