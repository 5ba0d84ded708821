// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/volume.h"

namespace pellucid::mpr {

/// What is between samples: a straight line, or the nearest sample.
enum class Interpolation { linear, nearest };

/// What a slab shows of the values along its thickness.
enum class SlabMode { mean, maximum, minimum };

/// A plane with a thickness, half of it on either side. Thin: the plane itself.
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

/// Samples on the volume's own lattice, tilted or not. A point belongs to the volume up to half a
/// sample beyond the outer sample centres, where the outer samples go on.
///
/// A slab is sampled at both faces and, from its middle, at every step of the lattice along its
/// normal: where planes lie on slices, its extremes are those of the samples and its mean the
/// integral of what is between them. Of a slab that is partly outside, the part inside counts.
SliceImage reslice(const volume::Volume &volume, const Plane &plane,
                   const ResliceOptions &options = {});

/// The value at a point, as reslice gives it.
float valueAt(const volume::Volume &volume, volume::PatientPoint point,
              Interpolation interpolation = Interpolation::linear);

} // namespace pellucid::mpr
