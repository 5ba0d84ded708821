// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

// Filters of values. All work on the volume's own lattice, in mm: a radius shorter than a step does
// not reach the neighbour along it. On a tilted lattice, distances are measured along the axes,
// also for the Gaussian before edges; only the derivatives of gradients and edges take the tilt
// into account. Beyond the border the outermost sample is repeated. All *throw* Error{outOfMemory},
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

} // namespace pellucid::preprocess
