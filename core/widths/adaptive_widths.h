// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/fourier/kernels_by_width.h"
#include "core/widths/block_energies.h"

namespace pellucid::widths {

/// The data for choosing the kernel widths of frames.
struct AdaptiveWidths {
    using Energies = std::vector<std::shared_ptr<const BlockEnergies>>;

    std::shared_ptr<const fourier::KernelsByWidth> kernels;
    Energies fields, gradients; ///< *Shape*: one for each of the engine's; or no gradients
    /// The permitted error of the choice, relative L2 of the whole projection. It is multiplied by
    /// `scene::detailGain` of the frame's image.
    double tolerance = 0.0;
};

} // namespace pellucid::widths
