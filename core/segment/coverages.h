// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/volume/coverage.h"

namespace pellucid::segment {

/// The region with soft edges, so that its projection does not ring: a discrete Gaussian with this
/// standard deviation along each axis of the lattice. Beyond the border of the lattice the
/// outermost sample is repeated. *Units*: samples. *Throws* std::bad_alloc.
volume::Coverage softened(const volume::Coverage &region, const volume::GridSize &size,
                          double sigma);

/// The same region on a lattice with coarser samples, each the mean of those in its cell.
volume::Coverage coarsened(const volume::Coverage &region, const volume::Lattice &from,
                           const volume::Lattice &to);

} // namespace pellucid::segment
