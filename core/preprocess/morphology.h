// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/preprocess/mask.h"
#include "core/task/progress.h"

namespace pellucid::preprocess {

// Masks by distance, with radii in mm as for the filters of values. All *throw* Error{outOfMemory},
// Cancelled; those of ITK also Error{internal}.

/// The union of all balls of a radius that fit into the mask.
Mask opening(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
/// All samples that no ball of a radius outside the mask covers.
Mask closing(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
/// The same by ITK's filters with a ball of samples as structuring element, for comparison.
/// Anatomical radii take seconds; by distance, as above, they take tenths.
Mask openingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress = {});
Mask closingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress = {});
/// All samples of the mask that are farther than a distance from all others. Beyond the border of
/// the lattice there are none.
Mask eroded(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
            const task::Progress &progress = {});
/// All samples within a distance of the mask.
Mask dilated(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
} // namespace pellucid::preprocess
