// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/preprocess/filters.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

/// The samples of a mask that are connected with the seeds by faces. Seeds outside the mask or the
/// lattice are ignored. *Throws* Error{outOfMemory}, Cancelled.
Mask connected(const volume::GridSize &size, const Mask &mask,
               const std::vector<volume::VoxelIndex> &seeds, const task::Progress &progress = {});

/// A region grown from seeds: the samples with values from `low` to `high` that are connected with
/// them.
struct Growth {
    std::vector<volume::VoxelIndex> seeds;
    double low = 0.0, high = 0.0;
    /// It does not pass through openings that are narrower than this: to leave a vessel through its
    /// wall, for example. 0: it passes through every opening. *Units*: mm.
    double leakMm = 0.0;
};

/// *Throws* Error{usage} if no seed has a value in the range, or none is within a ball of the
/// leak's width that fits there; Error{outOfMemory}; Cancelled.
Mask grownRegion(const volume::Volume &volume, const Growth &growth,
                 const task::Progress &progress = {});

} // namespace pellucid::preprocess
