// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/preprocess/mask.h"
#include "core/task/progress.h"

namespace pellucid::preprocess {

/// The parts of a mask that are connected by faces.
struct Parts {
    /// *Shape*: of each sample the number of its part from 1 on; 0 outside the mask.
    std::vector<std::uint32_t> labels;
    std::size_t count = 0;
};

/// `step`: the name for errors. *Throws* Error{outOfMemory}, Error{internal}, Cancelled.
Parts partsOf(const volume::Lattice &lattice, const Mask &mask, const char *step,
              const task::Progress &progress = {});

/// The smallest box around each part. *Shape*: by label; of no samples for 0.
std::vector<volume::VoxelBox> boxesOf(const Parts &parts, const volume::GridSize &size);

/// The part with the most samples, connected by faces, and all parts with at least that share of
/// its samples. *Throws* as above.
Mask largestPart(const volume::Lattice &lattice, const Mask &mask, double minShare = 1.0,
                 const task::Progress &progress = {});

} // namespace pellucid::preprocess
