// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/task/progress.h"
#include "core/volume/field.h"

namespace pellucid::classify {

/// The window that maps values to the field, in units of the values.
struct FieldWindow {
    double low = 0.0;
    double high = 1.0;
    bool operator==(const FieldWindow &) const = default;
};

/// Of CT, in HU: hides air and its noise.
inline constexpr FieldWindow ctFieldWindow{-900.0, 2000.0};
/// SUV. Beyond, organs that excrete a tracer would outshine all others.
inline constexpr FieldWindow uptakeFieldWindow{0.0, 10.0};
/// `ctFieldWindow` for HU and `uptakeFieldWindow` for SUV; for differences from 0 to the largest
/// 0.5 % of their magnitudes; for other volumes the 0.5 and 99.5 % quantiles of the finite samples.
FieldWindow defaultFieldWindow(const volume::Volume &volume);

/// The projected quantity on the volume's lattice: a density f in 0..1, or a weighted one.
struct DensityField {
    volume::Field values; ///< on the whole lattice
    volume::VoxelBox
        support; ///< smallest box that contains all nonzero samples; one sample if all are 0
};

/// f = clamp((value - low) / (high - low), 0, 1). NaN becomes 0, infinities are clamped; a window
/// of zero width gives 0 everywhere. The field holds the volume, not a copy. *Throws* Cancelled.
DensityField densityField(const volume::Volume &volume, const FieldWindow &window,
                          const task::Progress &progress = {});

/// A field of these samples on the lattice of `like`. *Shape*: as many samples as the lattice
/// has.
DensityField fieldOf(const volume::Field &like, std::vector<float> samples);
/// Values and the box that contains them.
DensityField fieldOf(volume::Field values, const task::Progress &progress = {});

} // namespace pellucid::classify
