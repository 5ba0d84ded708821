// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/shown_fields.h"

namespace pellucid::classify {

/// The visible part of a volume, in fractions of the lattice's axes between the outer faces of the
/// first and last samples, so that it also applies to coarser samples. Its faces are parallel to
/// those of the lattice's cells: in a tilted scan they are sheared like the scan.
struct CropBox {
    glm::dvec3 low{0.0}, high{1.0};
    bool isWhole() const { return *this == CropBox(); }
    bool operator==(const CropBox &) const = default;
};

/// *Throws* Error{usage} if an end is outside 0 to 1 or a side has no length.
void validate(const CropBox &box);

/// The samples with their centres in the box, at least one along every axis.
volume::VoxelBox samplesIn(const CropBox &box, const volume::GridSize &size);

/// The fields, zero outside the box, on the same lattice, so that views do not move.
DensityField cropped(DensityField field, const CropBox &box);
ShownFields cropped(ShownFields fields, const CropBox &box);

} // namespace pellucid::classify
