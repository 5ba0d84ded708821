// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "core/accuracy/central_rounding.h"
#include "core/accuracy/coarse_fields.h"
#include "core/accuracy/slice_energies.h"
#include "core/picture/projection_image.h"

namespace pellucid::accuracy {

/// A picture and the settings of its rendering.
struct PictureContext {
    const picture::ProjectionImage &picture;
    const scene::Camera &camera;
    const scene::ImageDefinition &image;
    const shading::Shading &shading;
    plan::SliceGrid grid;
    CentralEnergies central; ///< of the picture
    SliceEnergies slice;
    std::array<double, 3> narrowing{}; ///< see narrowingEnergies
};

/// The weights of a field's mass and energy in a channel.
struct FieldWeight {
    double mass = 0.0, energy = 0.0;
    bool isGradient = false;
};

/// The energies of one channel, and of its error. *Units*: of the picture squared, times mm^2.
struct ChannelEnergies {
    double image = 0.0, error = 0.0;
    bool isWhole = true; ///< no part of the fields is beside the picture
};

/// Predicts the energy of the error in one channel of a picture: aliases, rounding, roll-off tails,
/// narrower kernels, and the error of a linear cue's moment kernels. *Shape*: one weight per field.
/// `bound`: the plan's bound on the relative error.
ChannelEnergies channelEnergies(const CoarseFields &fields, double bound,
                                const PictureContext &context, int channel,
                                std::span<const FieldWeight> weights);

} // namespace pellucid::accuracy
