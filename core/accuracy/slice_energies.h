// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/render/frame_inputs.h"

namespace pellucid::accuracy {

/// Energies of a slice over its whole period, whatever the picture shows of it. They are estimated
/// from a random sample of its frequencies; the same slice always has the same sample. *Units*: of
/// the picture squared, times mm^2.
struct SliceEnergies {
    /// Directions of frequencies in the half plane: direction n is (n + 0.5) pi / directions from U
    /// toward V. The other half mirrors it.
    static constexpr int directions = 32;

    std::array<double, 3> whole{}; ///< by channel
    /// The energy per area of the frequency plane at the edge of the band, before the roll-off, by
    /// channel and direction. *Units*: frequencies in cycles per pixel.
    std::array<std::array<double, directions>, 3> edge{};
};

SliceEnergies sliceEnergies(const render::EngineSpectra &spectra, const render::FrameInputs &inputs,
                            const scene::Camera &camera, const scene::ImageDefinition &image);

} // namespace pellucid::accuracy
