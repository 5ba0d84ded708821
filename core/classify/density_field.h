// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::classify {

/// The window that maps values to the field, in value units.
struct FieldWindow {
    double low = 0.0;
    double high = 1.0;
    bool operator==(const FieldWindow &) const = default;
};

/// -900..2000 HU for CT, so that air and its noise vanish; for everything else the 0.5 and 99.5 %
/// quantiles of the finite samples.
FieldWindow defaultFieldWindow(const volume::Volume &volume);

/// What is projected, on the volume's own lattice: a density f in 0..1, or a weighted one.
struct DensityField {
    volume::Volume values; ///< float32, the whole lattice
    volume::VoxelBox
        support; ///< smallest box that holds every non-zero sample; one sample if all are 0
};

/// f = clamp((value - low) / (high - low), 0, 1). NaN is 0, infinities are clamped; a window
/// without width gives 0 everywhere. *Throws* Error{outOfMemory}, Cancelled.
DensityField densityField(const volume::Volume &volume, const FieldWindow &window,
                          const task::Progress &progress = {});

/// Samples on the lattice of a volume as a field. *Shape*: as many samples as the lattice has.
DensityField fieldOf(const volume::Volume &like, std::vector<float> samples);

} // namespace pellucid::classify
