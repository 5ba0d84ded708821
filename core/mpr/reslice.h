// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mpr/plane.h"
#include "core/volume/volume.h"

namespace pellucid::mpr {

/// A slice through a volume. *Shape*: height x width, rows from the top. *Units*: value units; NaN
/// outside the volume.
struct SliceImage {
    int width = 0, height = 0;
    std::vector<float> values;
};

/// Trilinear interpolation on the volume's own lattice, tilted or not. A point belongs to the
/// volume up to half a sample beyond the outer sample centres, where the outer samples go on.
SliceImage reslice(const volume::Volume &volume, const Plane &plane);

/// The value at a point, as reslice gives it.
float valueAt(const volume::Volume &volume, volume::PatientPoint point);

} // namespace pellucid::mpr
