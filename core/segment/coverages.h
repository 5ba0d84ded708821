// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/task/progress.h"
#include "core/volume/coverage.h"

namespace pellucid::segment {

/// The region with soft edges, so that its projection does not ring: a discrete Gaussian with this
/// standard deviation along each axis of the lattice. Beyond the border of the lattice the
/// outermost sample is repeated. *Units*: samples. *Throws* std::bad_alloc, Cancelled.
volume::Coverage softened(const volume::Coverage &region, const volume::GridSize &size,
                          double sigma, const task::Progress &progress = {});

/// The same region on a lattice with the same axes and coarser samples, each the mean of those in
/// its cell. *Throws* std::bad_alloc, Cancelled.
volume::Coverage coarsened(const volume::Coverage &region, const volume::Lattice &from,
                           const volume::Lattice &to, const task::Progress &progress = {});

} // namespace pellucid::segment
