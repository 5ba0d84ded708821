// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/render/frame_inputs.h"

namespace pellucid::accuracy {

/// The energies within a picture of the cells around frequency 0 and of their rounding error. Most
/// fields have nearly all their energy in a few dozen cells, so this error does not average out. It
/// is the actual error of these cells, in the same slices that the frame uses, cue and light
/// included.
struct CentralEnergies {
    /// By channel of the picture. *Units*: of the picture squared, times mm^2.
    std::array<double, 3> image{}, error{};
    std::array<double, 3> slice{}; ///< the cells' energy over the whole period
    /// The rounding error's energy over that of the cells, over all kept cells.
    double cellRounding = 0.0;
};

/// All are 0 if the spectra do not keep their rounding. Frequencies whose slice reads cells that
/// are not kept contribute 0.
CentralEnergies centralEnergies(const render::EngineSpectra &spectra,
                                const render::FrameInputs &inputs, const scene::Camera &camera);

} // namespace pellucid::accuracy
