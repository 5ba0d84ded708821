// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/density_field.h"

namespace pellucid::classify {

/// A field of at most `side` samples along each axis, each the mean of a block of the original's:
/// the mass stays, the detail goes. About the same centre, for a first quick picture.
DensityField coarseField(const DensityField &field, int side);

/// The values of a volume as means of blocks, with which it looks the same from afar.
volume::Volume coarseVolume(const volume::Volume &volume, int side);

} // namespace pellucid::classify
