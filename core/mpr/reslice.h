// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/volume.h"

namespace pellucid::mpr {

/// The value between samples: linear, or that of the nearest sample.
enum class Interpolation { linear, nearest };

/// The value of a slab, from the values along its thickness.
enum class SlabMode { mean, maximum, minimum };

/// A plane with a thickness, half of it on each side. Thickness 0: the plane itself.
struct Slab {
    double thicknessMm = 0.0;
    SlabMode mode = SlabMode::mean;
    bool operator==(const Slab &) const = default;
};

struct ResliceOptions {
    Interpolation interpolation = Interpolation::linear;
    Slab slab;
    bool operator==(const ResliceOptions &) const = default;
};

/// A slice through a volume. *Shape*: height x width, rows from the top. *Units*: value units; NaN
/// outside the volume.
struct SliceImage {
    int width = 0, height = 0;
    std::vector<float> values;
};

/// Samples on the volume's own lattice, tilted or not. The volume extends half a sample beyond the
/// outer sample centres, with the outer samples' values.
///
/// A slab is sampled at both faces and, starting from its middle, at every step of the lattice
/// along its normal. If its planes coincide with slices, its extremes are those of the samples, and
/// its mean is the integral of the interpolated values. Of a slab that is partly outside, only the
/// inner part counts.
SliceImage reslice(const volume::Volume &volume, const Plane &plane,
                   const ResliceOptions &options = {});

/// The value at a point, as in a slice.
float valueAt(const volume::Volume &volume, volume::PatientPoint point,
              Interpolation interpolation = Interpolation::linear);

} // namespace pellucid::mpr
