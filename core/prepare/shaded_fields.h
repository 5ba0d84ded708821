// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/classify/density_field.h"
#include "core/plan/render_plan.h"
#include "core/shading/slice_shading.h"

namespace pellucid::prepare {

/// The fields whose spectra an engine slices, on one lattice: those of the channels, and under
/// light the length of the gradient of each.
struct ShadedFields {
    std::vector<classify::DensityField> fields;
    std::vector<classify::DensityField> gradients; ///< one per field, or none
    shading::ShadingScale scale;
};

/// Without light only the fields. With light also their gradients, on the same lattice, which is
/// extended by one sample on every side if the gradients need it. *Throws* Error{outOfMemory},
/// Cancelled.
ShadedFields shadedFields(std::vector<classify::DensityField> fields,
                          const shading::Shading &shading, const shading::ShadingScale &scale,
                          const task::Progress &progress = {});

/// An upper bound on the bytes held at once while the gradients are made, besides the fields.
std::size_t bytesForLight(const shading::Shading &shading, const volume::GridSize &size,
                          std::size_t channels);

/// Summaries of the fields, then of the gradients, with what a plan with this cue needs.
std::vector<plan::FieldSummary> summarise(const ShadedFields &fields, const shading::DepthCue &cue);

/// The number of images in a frame of this many fields: a single field in colored light makes
/// three.
int imagesOf(std::size_t fields, const shading::Shading &shading);

} // namespace pellucid::prepare
