// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::phantom {

volume::Volume makeHead(const volume::Lattice &lattice, const task::Progress &progress);
volume::Volume makeChest(const volume::Lattice &lattice, const task::Progress &progress);
/// The notes of every phantom: CT, with a title and display windows.
volume::VolumeNotes phantomNotes(const std::string &title,
                                 std::vector<volume::ValueWindow> windows = {{40.0, 400.0, ""}});

/// Metal at 30000 HU among air: a water cylinder with rods and a screw.
volume::Volume makeMetal(const volume::Lattice &lattice, const task::Progress &progress);
/// 1000 HU everywhere: a field that fills its lattice into the corners.
volume::Volume makeCube(const volume::Lattice &lattice, const task::Progress &progress);
/// Bar patterns of 1 to 6 voxels along each axis.
volume::Volume makeBars(const volume::Lattice &lattice, const task::Progress &progress);
volume::Volume makeSphere(const volume::Lattice &lattice, const task::Progress &progress);
volume::Volume makeEllipsoids(const volume::Lattice &lattice, const task::Progress &progress);

} // namespace pellucid::phantom
