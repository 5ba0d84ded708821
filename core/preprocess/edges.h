// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/preprocess/filters.h"

namespace pellucid::preprocess {

/// |grad| of the values in value units per mm: grad = sum_d b_d D_d with D_d the central difference
/// along an axis and b_d the rows of the inverse of the lattice's steps, so that tilt and thick
/// slices are known. *Throws* Error{outOfMemory}, Cancelled.
volume::Volume gradientMagnitude(const volume::Volume &volume, const task::Progress &progress = {});

/// How Canny edges are found; thresholds in value units per mm.
struct CannyOptions {
    double sigmaMm = 1.0;
    double low = 0.0;  ///< an edge goes on while its gradient exceeds this
    double high = 0.0; ///< and starts where it exceeds this
};

/// The samples on edges: where the second derivative along the gradient changes its sign at a
/// maximum of the gradient's magnitude, linked through all 26 neighbours. On isotropic lattices the
/// same samples as ITK's filter, whose derivatives know no spacing. *Throws* Error{outOfMemory},
/// Cancelled. *Source*: Canny 1986; Cheng 2007, section 3.1.
Mask cannyEdges(const volume::Volume &volume, const CannyOptions &options,
                const task::Progress &progress = {});

/// The same by ITK's recursive Gaussian derivatives, zero crossings and double threshold, in mm.
/// The same samples on isotropic lattices and on thick slices, nearly the same in noise; but seven
/// times as slow, blind to a tilt, and nothing below four slices: hence not the usual method.
/// *Throws* as above, and Error{usage} for fewer than four samples along an axis or no smoothing.
Mask cannyEdgesByItk(const volume::Volume &volume, const CannyOptions &options,
                     const task::Progress &progress = {});

} // namespace pellucid::preprocess
