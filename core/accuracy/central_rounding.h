// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/render/projection_engine.h"

namespace pellucid::accuracy {

/// The energies, within a picture, of the part that comes from the cells around frequency 0, and of
/// the error that the rounding of these cells makes. Most fields have nearly all their energy in
/// a few dozen cells, so their error does not average out: it is what these cells happen to round
/// to, seen through the very slices that the frame takes, cue and light included.
struct CentralEnergies {
    /// By channel of the picture. *Units*: of the picture squared, times mm^2.
    std::array<double, 3> image{}, error{};
    /// The rounding's energy over that of the cells, all of those that are kept.
    double ofCells = 0.0;
};

/// All are 0 if an engine's spectra do not keep their rounding. Frequencies at which a slice reads
/// cells beyond those that are kept contribute 0. *Shape*: the grid is that of the camera's frame.
CentralEnergies centralEnergies(const render::EngineParts &engine, const scene::Camera &camera,
                                const plan::SliceGrid &grid, const shading::Shading &shading);

} // namespace pellucid::accuracy
