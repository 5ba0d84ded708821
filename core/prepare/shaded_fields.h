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
    std::vector<classify::DensityField> gradients; ///< as many, or none
    shading::ShadingScale scale;
};

/// Without light the fields themselves. With it their gradients too, on the same lattice, one
/// sample larger on every side if the gradients need it. *Throws* Error{outOfMemory}, Cancelled.
ShadedFields shadedFields(std::vector<classify::DensityField> fields,
                          const shading::Shading &shading, const shading::ShadingScale &scale,
                          const task::Progress &progress = {});

/// Bytes held at once while they are made, beside the fields, at most.
std::size_t bytesForLight(const shading::Shading &shading, const volume::GridSize &size,
                          std::size_t channels);

/// Of fields, then gradients, with what the plan of a scene with this cue needs.
std::vector<plan::FieldSummary> summarise(const ShadedFields &fields, const shading::DepthCue &cue);

/// How many images a frame of so many fields takes: coloured light makes three of one.
int imagesOf(std::size_t fields, const shading::Shading &shading);

} // namespace pellucid::prepare
