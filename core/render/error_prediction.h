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

/// What one axis of a layout leaves, relative to the energy of the field.
struct AxisError {
    /// sum_x e(x) sum_m r^2 with r = h(x + m)/h(x), the amplitude of the ghost of x in period m.
    double ghosts = 0.0;
    /// integral H^2 times sum_x e(x)/h(x)^2: how rounding of the cells reaches the image.
    double noise = 1.0;
};

/// *Shape*: one energy per sample of the axis; *Units*: padded in samples.
AxisError axisError(const fourier::Kernel &kernel, int padded, const std::vector<double> &energy);

/// How much of what the ghosts and the rounding spread over the period falls into the image,
/// relative to the share of the projection's energy that the image holds.
struct ImageShare {
    double inImage = 1.0;
};

/// The relative L2 error of an image from a direction that no axis is close to, or along an axis,
/// whichever is worse. A ghost lies one or more padded periods away along its axis. Seen across the
/// axis it lands anywhere in the slice's period, hence in the image by its share of the area; seen
/// along the axis all of it falls onto the projection. Rounding to binary16 leaves 2.1e-4 of each
/// cell, spread evenly over the period; rounding to float and summing 3e-7.
double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const ImageShare &share);

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
