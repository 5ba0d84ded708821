// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/spectrum.h"

namespace pellucid::render {

/// How a field's energy f^2 is spread along each axis of its box; sums to 1 on each axis.
struct EnergyMarginals {
    std::array<std::vector<double>, 3> axis;
    /// (sum f)^2 / sum f^2: 1 for a point, the number of samples for a block.
    double effectiveSamples = 1.0;
};

/// *Shape*: one entry per sample of the box on every axis.
EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box);

/// The relative L2 error of an image that the kernel's ghosts leave: on axis d the ghost of voxel x
/// in period m has the amplitude r = h(x + m padded)/h(x), and
///   error^2 = prod_d (1 + sum_x energy_d(x) sum_m r^2) - 1.
/// Ghosts that land outside the image are counted too, so this is high rather than low.
double predictRelativeError(const fourier::SpectrumLayout &layout, const EnergyMarginals &energy);

/// How far the response of a raised-cosine edge over a share F of the band is followed, in pixels:
/// 4/F, and never further than 256.
double ringingPixels(double rollOff);

/// The relative L2 error that the tails of the roll-off leave when they fold back into the image.
/// *Units*: `roomPixels` is the part of the slice grid's period outside the image. `share` is the
/// image's side over the period's.
///
/// A sharp disc leaves sqrt(2/(pi^2 r)) of a point's response beyond r pixels; a roll-off F lowers
/// that by (0.3/(F r))^2 (measured); the share of it that lands in the image is as the areas are.
/// Extended fields have less at the edge of the band: their tails add incoherently, which the
/// fourth root of the number of samples bounds for noise and more so for anatomy (measured from one
/// voxel to 256^3).
double predictFoldedTails(double rollOff, double roomPixels, double share, double effectiveSamples);

} // namespace pellucid::render
