// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/preprocess/mask.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::preprocess {

/// |grad| of the values in value units per mm, correct for tilted lattices and thick slices:
/// grad = sum_d b_d D_d, where D_d is the central difference along an axis and b_d are the rows of
/// the inverse of the lattice's steps. *Throws* Error{outOfMemory}, Cancelled.
volume::Volume gradientMagnitude(const volume::Volume &volume, const task::Progress &progress = {});

/// How Canny edges are found. *Units*: thresholds in value units per mm.
struct CannyOptions {
    double sigmaMm = 1.0;
    double low = 0.0;  ///< an edge continues while its gradient exceeds this
    double high = 0.0; ///< an edge starts where its gradient exceeds this
};

/// The samples on edges: those at which the second derivative along the gradient changes its sign
/// at a maximum of the gradient's magnitude, linked through all 26 neighbours. *Throws*
/// Error{outOfMemory}, Cancelled. *Source*: Canny 1986; Cheng 2007, section 3.1.
///
/// Not ITK's Canny filter, whose derivatives are per sample and ignore the spacing; on isotropic
/// lattices both find the same samples.
Mask cannyEdges(const volume::Volume &volume, const CannyOptions &options,
                const task::Progress &progress = {});

/// The same by ITK's recursive Gaussian derivatives, zero crossings and double threshold, in mm,
/// for comparison. It finds the same edges on isotropic lattices and thick slices, and almost the
/// same in noise. It is not the default, because it takes seven times as long, ignores a tilt, and
/// needs at least four slices. *Throws* as above, and Error{usage} for fewer than four samples
/// along an axis or no smoothing.
Mask cannyEdgesByItk(const volume::Volume &volume, const CannyOptions &options,
                     const task::Progress &progress = {});

} // namespace pellucid::preprocess
