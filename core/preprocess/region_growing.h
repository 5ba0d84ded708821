// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/preprocess/mask.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

/// The samples of a mask that are connected with the seeds by faces. Seeds outside the mask or the
/// lattice are ignored. *Throws* Error{outOfMemory}, Cancelled.
Mask connected(const volume::GridSize &size, const Mask &mask,
               const std::vector<volume::VoxelIndex> &seeds, const task::Progress &progress = {});

/// The same for places in the patient, each of which starts from the nearest sample of the mask
/// within a sample's distance. It does not pass through openings that are narrower than `leakMm`:
/// to leave a vessel through its wall, for example. 0: it passes through every opening. *Throws* as
/// above.
Mask connectedWith(const volume::Lattice &lattice, const Mask &mask,
                   const std::vector<volume::PatientPoint> &points, double leakMm,
                   const task::Progress &progress = {});

/// The mask with its holes filled: the samples that are not connected, by faces outside the mask,
/// with the border of the grid. *Throws* as above.
Mask withoutHoles(const volume::GridSize &size, const Mask &mask,
                  const task::Progress &progress = {});

/// A region grown from seeds: the samples with values from `low` to `high` that are connected with
/// them.
struct Growth {
    std::vector<volume::VoxelIndex> seeds;
    double low = 0.0, high = 0.0;
    double leakMm = 0.0; ///< as for `connectedWith`
};

/// *Throws* Error{usage} if no seed has a value in the range, or none is within a ball of the
/// leak's width that fits there; Error{outOfMemory}; Cancelled.
Mask grownRegion(const volume::Volume &volume, const Growth &growth,
                 const task::Progress &progress = {});

} // namespace pellucid::preprocess
