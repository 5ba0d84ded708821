// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/classify/shown_fields.h"
#include "core/plan/frame_model.h"
#include "core/prepare/measured_error.h"
#include "core/prepare/shaded_fields.h"
#include "core/render/cpu_engine.h"

namespace pellucid::prepare {

/// A plan that fits in memory, if necessary for reduced fields.
struct FittingPlan {
    plan::RenderPlan plan;
    /// The fields to render instead of the originals: means of up to `reduction` samples an axis.
    std::optional<ShadedFields> reduced;
    int reduction = 1;
};

/// Plans within the budget. What does not fit is reduced in this order: storage, padding,
/// resolution. The predicted error of a reduced field includes the lost detail, as its share of the
/// field's energy: projections lose less, because they also average. *Shape*: the fields'
/// summaries. *Throws* Error{outOfMemory} if 32 samples a side do not fit either, or if the image
/// itself is too large; Cancelled.
FittingPlan planWithin(const scene::Scene &scene, const ShadedFields &fields,
                       std::span<const plan::FieldSummary> summaries, const plan::Budget &budget,
                       const task::Progress &progress = {});

/// An engine, ready to render.
struct PreparedEngine {
    std::shared_ptr<render::ProjectionEngine> engine;
    plan::RenderPlan plan;
    std::size_t bytes = 0; ///< of the spectra
    bool canBeLit = false;
    /// Whether the prepared fields are coarser than the study, which the plan's error does not
    /// include.
    bool isCoarse = false;
    plan::SpectrumOf of = plan::SpectrumOf::look;
    int reduction = 1; ///< of the fields, because of the memory
    StudyFields study; ///< what its pictures are measured against; empty: nothing
};

/// The data for choosing the kernel widths of a plan's frames; null if one width reads everything.
/// *Throws* Error{outOfMemory}, Cancelled.
std::shared_ptr<const widths::AdaptiveWidths> adaptiveWidths(const render::EngineSpectra &spectra,
                                                             const plan::RenderPlan &plan,
                                                             const task::Progress &progress = {});

/// Makes an engine for the channels of a look from spectra that were prepared by one plan and share
/// a layout. Each field is released as soon as its samples are transformed.
std::shared_ptr<render::CpuEngine> makeEngine(ShadedFields channels, const plan::RenderPlan &plan,
                                              const task::Progress &progress = {});

/// Plans within the budget and prepares the spectra; the fields are released as by `makeEngine`.
/// *Throws* Error{outOfMemory}, Cancelled.
PreparedEngine prepareEngine(const scene::Scene &scene, ShadedFields fields,
                             const plan::Budget &budget, const task::Progress &progress = {});
/// First computes what the scene's light needs. `scale`: that of the volume, if the fields come
/// from a coarser one. *Throws* as above.
PreparedEngine prepareEngine(const scene::Scene &scene, classify::ShownFields fields,
                             const plan::Budget &budget, const task::Progress &progress = {},
                             const std::optional<shading::ShadingScale> &scale = std::nullopt);

/// What is known of the error of whole pictures before it is measured: the plan's bound. Not set
/// for the sum of layers, and for fields that are coarser than the study.
std::optional<error::StatedError> boundOf(const PreparedEngine &prepared,
                                          const scene::ImageDefinition &image);

/// The same engine without its lights; its error is at most what it was with them.
PreparedEngine withoutLight(const PreparedEngine &prepared);

} // namespace pellucid::prepare
