// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/fourier/spectrum.h"

namespace pellucid::render {

/// How a field's energy f^2 is spread along each axis of its box; sums to 1 on each axis.
struct EnergyMarginals {
    std::array<std::vector<double>, 3> axis;
};

/// *Shape*: one entry per sample of the box on every axis.
EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box);

/// The relative L2 error of an image that the kernel's ghosts leave: on axis d the ghost of voxel x
/// in period m has the amplitude r = h(x + m padded)/h(x), and
///   error^2 = prod_d (1 + sum_x energy_d(x) sum_m r^2) - 1.
/// Ghosts that land outside the image are counted too, so this is high rather than low.
double predictRelativeError(const fourier::SpectrumLayout &layout, const EnergyMarginals &energy);

} // namespace pellucid::render
