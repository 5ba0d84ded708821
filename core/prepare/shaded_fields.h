// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/classify/shown_fields.h"
#include "core/plan/render_plan.h"
#include "core/shading/slice_shading.h"

namespace pellucid::prepare {

/// The fields whose spectra an engine slices, on one lattice: those of the channels, and under
/// light the length of the gradient of each.
struct ShadedFields {
    std::vector<classify::DensityField> fields;
    std::vector<classify::DensityField> gradients; ///< one per field, or none
    shading::ShadingScale scale;
    std::array<classify::Color, 3> colors; ///< of the fields of a look
};

/// Without light only the fields. With light those of the channels of the picture, because light is
/// not linear in them, and their gradients, on the same lattice, which is extended by one sample on
/// every side if the gradients need it. *Throws* Error{outOfMemory}, Cancelled.
ShadedFields shadedFields(classify::ShownFields fields, const shading::Shading &shading,
                          const shading::ShadingScale &scale, const task::Progress &progress = {});

/// An upper bound on the bytes held at once while the gradients of a look of so many channels are
/// made, besides its fields.
std::size_t bytesForLight(const shading::Shading &shading, const volume::GridSize &size,
                          std::size_t channels);

/// An upper bound on the bytes held at once, besides the volume, while the fields of a look and
/// what its shading needs are made.
std::size_t bytesForFields(const classify::Look &look, const shading::Shading &shading,
                           const volume::GridSize &size);

/// Summaries of the fields, then of the gradients, with what a plan with this cue needs.
std::vector<field::Summary> summarise(const ShadedFields &fields, const shading::DepthCue &cue);

/// The picture of a look of this many fields, see `classify::ShownFields`.
plan::Composition compositionOf(std::size_t fields, const shading::Shading &shading);

} // namespace pellucid::prepare
