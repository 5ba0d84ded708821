// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

// Every filter works on the volume's own lattice, in mm: a radius that is shorter than a step does
// not reach the neighbour along it. On a tilted lattice distances are taken along the axes, that of
// the Gaussian before edges too; the derivatives of gradients and edges know the tilt. Beyond the
// border the outermost sample goes on. Each *Throws* Error{outOfMemory}, Error{internal} naming the
// filter, Cancelled.

/// Standard deviation in mm; the discrete Gaussian, exact for less than a sample too.
volume::Volume gaussian(const volume::Volume &volume, double sigmaMm,
                        const task::Progress &progress = {});
/// Of the box that reaches radiusMm to all sides.
volume::Volume median(const volume::Volume &volume, double radiusMm,
                      const task::Progress &progress = {});
/// Curvature anisotropic diffusion with the longest stable time step.
volume::Volume diffusion(const volume::Volume &volume, int iterations, double conductance,
                         const task::Progress &progress = {});

/// A set of samples. *Shape*: one of each sample, 0 or 1.
using Mask = std::vector<std::uint8_t>;

/// What balls of a radius inside the mask cover, and what balls outside it leave.
Mask opening(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
Mask closing(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
/// The same by ITK's filters, with a ball of the samples that the radius reaches: seconds for the
/// radii of anatomy, where the distances above take tenths. It is the method that others compare
/// with, not the usual one.
Mask openingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress = {});
Mask closingByItk(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
                  const task::Progress &progress = {});
/// All samples within a distance of the mask.
Mask dilated(const volume::Lattice &lattice, const Mask &mask, double radiusMm,
             const task::Progress &progress = {});
/// The part with most samples, connected by faces, and every other with at least a share of them.
Mask largestPart(const volume::Lattice &lattice, const Mask &mask, double leastShare = 1.0,
                 const task::Progress &progress = {});
/// The patient: the largest part above air (-400 HU, or Otsu's threshold) that is thicker than the
/// couch's shell, with what is thin and short at it (ears, a nose, fingers), with everything that a
/// slice encloses, and a margin.
Mask body(const volume::Volume &volume, double marginMm, const task::Progress &progress = {});
/// What of the body with its margin is not deeper in the body than a depth.
Mask skin(const volume::Volume &volume, double depthMm, double marginMm,
          const task::Progress &progress = {});

} // namespace pellucid::preprocess
