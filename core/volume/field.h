// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "core/volume/volume.h"

namespace pellucid::volume {

/// The line (value - low) * scale, clamped to 0..1. NaN becomes 0.
struct Ramp {
    float low = 0.0F, scale = 1.0F;
    float operator()(float value) const {
        return std::max(0.0F, std::min((value - low) * scale, 1.0F)); // in this order NaN becomes 0
    }
};

/// Real values on a lattice: the samples of a volume, or a ramp of them, and 0 outside a box. They
/// are computed whenever they are read: a copy of the volume as floats would take more time, and
/// twice its memory. Immutable, shared and cheap to copy.
class Field {
public:
    Field() : Field(Volume()) {}
    Field(Volume samples); // implicit: every volume is a field
    Field(Volume samples, const Ramp &ramp);
    /// The same field, and 0 outside a box.
    Field within(const VoxelBox &box) const;

    const Lattice &lattice() const { return m_samples.lattice(); }
    /// The volume that the values are read from.
    const Volume &samples() const { return m_samples; }
    /// A pointer to `count` values of a row of the lattice: into the samples if they can be read in
    /// place, else `buffer`, which is filled. Valid while field and buffer are unchanged. *Shape*:
    /// `buffer` has room for `count` values.
    const float *row(VoxelIndex first, int count, float *buffer) const;
    void copyRow(VoxelIndex first, int count, float *to) const;
    double value(VoxelIndex n) const;
    /// The values as a volume of floats without a unit. *Throws* Error{outOfMemory}.
    Volume asVolume() const;

private:
    void computeRow(VoxelIndex first, int count, float *to) const;

    Volume m_samples;
    std::optional<Ramp> m_ramp;
    VoxelBox m_box;
};

} // namespace pellucid::volume
