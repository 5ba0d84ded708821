// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/picture/contrast.h"
#include "core/scene/camera.h"

namespace pellucid::picture {

/// Vector code for rows of the pyramid. Rows that are read or written have at least `rowSlack`
/// elements beyond their width.
inline constexpr int rowSlack = 64;
inline constexpr int maxRowWidth = scene::largestImageSize;

/// One row of four neighbors down: weights 1, 3, 3, 1 over 8.
using FourRows = std::array<const float *, 4>;

/// The brightest channel of each pixel.
void brightest(const float *pixels, int count, int channels, float *to);
/// Means of 2 x 2 or 4 x 4 pixels. *Shape*: `rows`: `factor` rows of `width`; the last pixel is
/// repeated.
void average(const float *const *rows, int factor, int width, float *to);
/// Halves a row, which weights the values by the body's share of each.
void halveBody(const FourRows &rows, int width, const AirRamp &air, float *values, float *shares);
void halve(const FourRows &rows, int width, float *to);
/// Doubles a row between two: 3/4 `near` + 1/4 `far`, then the same along the row.
void expand(const float *near, const float *far, int coarseWidth, float *to, int width);

struct BandFactors {
    float scale, amplification, bend; ///< scale: of amplitudes: 1 / (bright x knee)
};
/// A level's means from weighted values and shares, with the coarser one where the share is below
/// 1, and its processed picture. `coarser`, `processed`: expanded; `processed` is replaced.
void combine(const float *values, const float *shares, const float *coarser, float *processed,
             int width, const BandFactors &factors, float *means);
/// The correction on the finest grid. `processed` is replaced by it.
void combineFinest(const float *values, const AirRamp &air, const float *coarser, float *processed,
                   int width, const BandFactors &factors);
/// Linear interpolation of a row on a grid `factor` times finer (1, 2 or 4), between two rows.
void interpolate(const float *above, const float *below, float weightBelow, int coarseWidth,
                 int factor, float *to, int width);

} // namespace pellucid::picture
