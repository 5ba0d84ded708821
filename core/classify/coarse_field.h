// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/classify/density_field.h"

namespace pellucid::classify {

/// A field of at most `side` samples along each axis, each the mean of a block of the original. It
/// has the same mass and the same centre but less detail, for a fast first picture.
DensityField coarseField(const DensityField &field, int side);
/// The size of such a field.
volume::GridSize coarseSize(const volume::GridSize &size, int side);
/// The side of a field that is coarser by this factor along its longest axis; 0 below 32 samples,
/// which show nothing.
int coarseSide(const volume::GridSize &size, int reduction);

/// The values of a volume as means of blocks, which look the same from a distance.
volume::Volume coarseVolume(const volume::Volume &volume, int side);
/// The same with blocks of that many samples along each axis. The grid of blocks is centered on the
/// volume.
volume::Volume coarseVolume(const volume::Volume &volume, const std::array<int, 3> &block);
/// The largest blocks whose sides are at most `largestMm`.
std::array<int, 3> blocksWithin(const volume::Lattice &lattice, double largestMm);

} // namespace pellucid::classify
