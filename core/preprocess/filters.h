// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

// All filters work on the volume's own lattice, in mm: a radius shorter than a step does not reach
// the neighbour along it. On a tilted lattice, distances are measured along the axes, also for the
// Gaussian before edges; only the derivatives of gradients and edges take the tilt into account.
// Beyond the border the outermost sample is repeated. All *throw* Error{outOfMemory},
// Error{internal} naming the filter, and Cancelled.

/// The discrete Gaussian with a standard deviation in mm, accurate below one sample, too.
volume::Volume gaussian(const volume::Volume &volume, double sigmaMm,
                        const task::Progress &progress = {});
/// The median of a box that extends radiusMm in each direction.
volume::Volume median(const volume::Volume &volume, double radiusMm,
                      const task::Progress &progress = {});
/// Curvature anisotropic diffusion with the longest stable time step.
volume::Volume diffusion(const volume::Volume &volume, int iterations, double conductance,
                         const task::Progress &progress = {});

/// A set of samples. *Shape*: one of each sample, 0 or 1.
using Mask = std::vector<std::uint8_t>;

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
/// The part with the most samples, connected by faces, and all parts with at least that share of
/// its samples.
Mask largestPart(const volume::Lattice &lattice, const Mask &mask, double minShare = 1.0,
                 const task::Progress &progress = {});
/// The patient: the largest part above air (-400 HU, or Otsu's threshold) that is thicker than the
/// couch's shell; thin, short parts that touch it (ears, nose, fingers); all that a slice encloses;
/// and a margin.
Mask body(const volume::Volume &volume, double marginMm, const task::Progress &progress = {});
/// The part of the body and its margin that is at most a depth below the body's surface.
Mask skin(const volume::Volume &volume, double depthMm, double marginMm,
          const task::Progress &progress = {});

} // namespace pellucid::preprocess
