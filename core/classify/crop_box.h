// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/shown_fields.h"

namespace pellucid::classify {

/// The part of a volume that is shown, in shares of the lattice's axes from the outer face of the
/// first sample to that of the last, so that it means the same on coarser samples. Its faces are
/// those of the lattice's own cells: of a tilted scan they lean as the scan does.
struct CropBox {
    glm::dvec3 low{0.0}, high{1.0};
    bool isWhole() const { return *this == CropBox(); }
    bool operator==(const CropBox &) const = default;
};

/// *Throws* Error{usage} if an end is out of 0 to 1 or a side has no length.
void validate(const CropBox &box);

/// The samples whose centres lie in the box, one on every axis at least.
volume::VoxelBox samplesIn(const CropBox &box, const volume::GridSize &size);

/// The fields with nothing outside the box, on the same lattice: views do not move.
/// *Throws* Error{outOfMemory}.
DensityField cropped(DensityField field, const CropBox &box);
ShownFields cropped(ShownFields fields, const CropBox &box);

} // namespace pellucid::classify
