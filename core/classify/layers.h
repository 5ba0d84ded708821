// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/classify/class_samples.h"
#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::classify {

/// A field that is projected once and shown with any weight and color: a term f b_i(f) of a Bézier
/// transfer function, a class, or, of many classes, a channel of all but one. *Source*: Cheng 2007,
/// eq. 32 and 36.
struct Layer {
    /// The class without its own weight and color; unnamed: the whole volume.
    TissueClass tissue;
    int index = -1, degree = 0;   ///< b_index of the degree; -1: none
    double low = 0.0, high = 1.0; ///< the range of densities of b_index
    /// The classes whose sum it is, as channel `channel` of their look; none: it is `tissue`.
    std::vector<TissueClass> sum;
    int channel = 0;
    bool operator==(const Layer &) const = default;
};

/// Layers and their channel weights: a look is the sum of weight times layer.
struct Mixture {
    std::vector<Layer> layers;
    std::vector<std::array<double, 3>>
        channelWeights; ///< of red, green and blue, one entry per layer
};

/// Up to this many classes are a layer each.
inline constexpr std::size_t maxLayers = 8;

/// A look as a mixture. Looks that differ only in weights, colors and control points have the same
/// layers. Classes with zero weight are layers too, so that they can be shown at once. With more
/// than `maxLayers` classes, only the adjusted one is a layer of its own, and the others are
/// summed: then looks that differ only in that one's weight and color have the same layers.
/// `adjusted`: its index; not set: no class is adjusted.
Mixture mixtureOf(const Look &look, std::optional<std::size_t> adjusted = std::nullopt);

/// The index of the only class in which two looks differ, if they have the same number of classes
/// and differ in nothing else.
std::optional<std::size_t> onlyDifference(const Look &a, const Look &b);

/// The field of a layer. `runner`: as for `shownFields`. *Throws* Error{outOfMemory}, Cancelled.
DensityField layerField(const volume::Volume &volume, const FieldWindow &window, const Layer &layer,
                        StepRunner *runner, const task::Progress &progress = {});

/// Makes the fields of the layers of a mixture, one after the other, the channels of a sum at once.
class LayerFields {
public:
    /// *Requires*: the runner outlives this object.
    LayerFields(volume::Volume volume, const FieldWindow &window, Mixture mixture,
                StepRunner *runner);
    std::size_t count() const { return m_mixture.layers.size(); }
    /// *Requires*: each once, in order. *Throws* Error{outOfMemory}, Cancelled.
    DensityField field(std::size_t layer, const task::Progress &progress = {});

private:
    volume::Volume m_volume;
    FieldWindow m_window;
    Mixture m_mixture;
    StepRunner *m_runner;
    std::vector<DensityField> m_channels; ///< of the sum, until each is taken
};

} // namespace pellucid::classify
