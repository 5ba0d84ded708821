// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/accuracy/detail_loss.h"
#include "core/accuracy/view_error.h"
#include "core/classify/shown_fields.h"
#include "core/plan/frame_model.h"
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
    /// Predicts the error of single pictures of the prepared fields. Null if the plan reduced the
    /// fields: then the plan's own error includes that.
    std::shared_ptr<const accuracy::ViewErrorModel> viewError;
    /// Whether the prepared fields are coarser than the study. Then `detailLoss` predicts the
    /// resulting error; it is null until it has been computed.
    bool isCoarse = false;
    std::shared_ptr<const accuracy::DetailLoss> detailLoss;
    plan::SpectrumOf of = plan::SpectrumOf::look;
};

/// The widths that frames of a plan are read by; null if one width reads everything. *Throws*
/// Error{outOfMemory}, Cancelled.
std::shared_ptr<const plan::AdaptiveWidths> adaptiveWidths(const render::EngineSpectra &spectra,
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

/// The relative L2 error of a picture against that of the study. Not set until the loss of detail
/// has been computed.
std::optional<double> errorOf(const PreparedEngine &prepared,
                              const picture::ProjectionImage &picture, const scene::Camera &camera,
                              const scene::ImageDefinition &image, const shading::Shading &shading);
/// The same for a whole picture whose error against the prepared fields is known.
std::optional<double> errorAgainstStudy(const PreparedEngine &prepared, double fieldError,
                                        const shading::Shading &shading);

/// The same engine without its lights; its error is at most what it was with them.
PreparedEngine withoutLight(const PreparedEngine &prepared);

} // namespace pellucid::prepare
