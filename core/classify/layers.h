// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/classify/class_samples.h"
#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::classify {

/// A field that is projected once and shown with any weight and color: a term f b_i(f) of a Bézier
/// transfer function, or a class. *Source*: Cheng 2007, eq. 32 and 36.
struct Layer {
    /// The class without its own weight and color; unnamed: the whole volume.
    TissueClass tissue;
    int index = -1, degree = 0; ///< b_index of the degree; -1: none
    bool operator==(const Layer &) const = default;
};

/// Layers and their channel weights: a look is the sum of weight times layer.
struct Mixture {
    std::vector<Layer> layers;
    std::vector<std::array<double, 3>>
        channelWeights; ///< of red, green and blue, one entry per layer
};

/// A look as a mixture. Looks that differ only in weights, colors and control points have the same
/// layers. Classes with zero weight are layers too, so that they can be shown at once.
Mixture mixtureOf(const Look &look);

/// The field of a layer. *Throws* Error{outOfMemory}, Cancelled.
DensityField layerField(const volume::Volume &volume, const FieldWindow &window, const Layer &layer,
                        StepRunner *runner, const task::Progress &progress = {});

} // namespace pellucid::classify
