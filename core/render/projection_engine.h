// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/classify/shown_fields.h"
#include "core/fourier/spectrum.h"
#include "core/picture/projector.h"
#include "core/plan/slice_grid.h"
#include "core/shading/slice_shading.h"
#include "core/widths/adaptive_widths.h"

namespace pellucid::render {

/// A field's weights in red, green and blue.
using ChannelWeights = std::array<double, 3>;

/// Whether all weights are grey, so that one channel is enough.
inline bool areGrey(std::span<const ChannelWeights> channelWeights) {
    return std::all_of(
        channelWeights.begin(), channelWeights.end(),
        [](const ChannelWeights &share) { return share[0] == share[1] && share[1] == share[2]; });
}

/// Those of the fields of a look.
std::vector<ChannelWeights> channelWeightsOf(const classify::ShownFields &fields);

/// The rank of the weights; 0 if all are grey.
int colorsOf(std::span<const ChannelWeights> channelWeights);

/// The spectra that an engine slices; all have the same layout.
struct EngineSpectra {
    using Spectra = std::vector<std::shared_ptr<const fourier::Spectrum>>;
    Spectra fields;
    Spectra gradients; ///< of the |g| of each field, for light; may be empty
    shading::ShadingScale scale;
};

/// The data that an engine makes pictures from. Another engine makes the same pictures from them.
struct EngineParts {
    EngineSpectra spectra;
    std::vector<ChannelWeights> channelWeights; ///< one entry per field
    plan::FieldOfView fieldOfView;
    /// The data for choosing kernel widths; null: the layout's own kernel reads everything.
    std::shared_ptr<const widths::AdaptiveWidths> adaptive;
};

/// Makes projections of prepared fields by slicing their spectra. Engines are interchangeable:
/// under the same plan they give the same image within a stated rounding bound.
class ProjectionEngine : public picture::PeriodProjector {
public:
    virtual EngineParts parts() const = 0;
};

} // namespace pellucid::render
