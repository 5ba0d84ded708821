// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/classify/shown_fields.h"
#include "core/plan/frame_model.h"
#include "core/prepare/measured_error.h"
#include "core/prepare/shaded_fields.h"
#include "core/render/cpu_engine.h"
#include "core/render/sum_engine.h"

namespace pellucid::prepare {

/// A request for an engine: a scene, its fields, and the memory for them.
struct EngineRequest {
    scene::Scene scene; ///< planned for as `scene::planningScene` says
    /// The fields of the scene's look, in its crop. Each is released as soon as its samples are
    /// transformed.
    classify::ShownFields fields;
    plan::Budget budget = {};
    /// The scale of the volume, if the fields come from a coarser one.
    std::optional<shading::ShadingScale> scale = {};
    /// Whether the exact reference makes the pictures if no plan keeps the tolerance: not if memory
    /// is short, the scene sets the interpolation, or the plan is for the whole volume.
    bool mayBeExact = false;
    /// Whether `render::SumEngine` may make the pictures, where `plan::sumsPay` says so.
    bool mayBeSums = false;
    /// How many will be made. A plan for the whole volume is the workstation's, so that its
    /// pictures can be made again.
    int pictures = plan::Composition().pictures;
};

/// A plan that fits in memory, and the fields that it is for: those given, or means of `reduction`
/// samples along each axis.
struct FittingPlan {
    plan::RenderPlan plan;
    ShadedFields fields;
    std::vector<field::Summary> summaries; ///< of the fields
    int reduction = 1;
};

/// Plans within the budget. What does not fit is reduced in this order: storage, padding,
/// resolution. The plan's error is that of the images of the reduced fields; what these lack is
/// measured in each picture. *Throws* Error{outOfMemory} if 32 samples a side do not fit either, or
/// if the image itself is too large; Cancelled.
FittingPlan planWithin(const scene::Scene &scene, ShadedFields fields,
                       const plan::Composition &composition, const plan::Budget &budget,
                       const task::Progress &progress = {});

/// *Throws* Error{outOfMemory} if pictures need more bytes than the budget has.
void requireWithin(std::size_t needed, const plan::Budget &budget);

/// An engine that is ready to render a look, or what makes its pictures without spectra.
struct PreparedEngine {
    /// One of these makes the pictures; the others are null.
    std::shared_ptr<render::ProjectionEngine> engine;
    std::shared_ptr<render::SumEngine> sums;
    std::shared_ptr<picture::Projector> exact;
    plan::RenderPlan plan;   ///< for the exact reference: its error and bytes
    volume::Lattice lattice; ///< of the prepared fields
    std::size_t bytes = 0;   ///< of the spectra
    bool canBeLit = false;
    /// Whether the prepared fields are coarser than the study, which the plan's error does not
    /// include.
    bool isCoarse = false;
    plan::SpectrumOf of = plan::SpectrumOf::look;
    StudyFields study; ///< what its pictures are measured against; empty: nothing

    picture::Projector &projector() const { return exact ? *exact : measurable(); }
    /// *Requires*: the exact reference does not make the pictures.
    picture::PeriodProjector &measurable() const {
        return engine ? static_cast<picture::PeriodProjector &>(*engine) : *sums;
    }
};

/// The data for choosing the kernel widths of a plan's frames; null if one width reads everything.
/// *Throws* Error{outOfMemory}, Cancelled.
std::shared_ptr<const widths::AdaptiveWidths> adaptiveWidths(const render::EngineSpectra &spectra,
                                                             const plan::RenderPlan &plan,
                                                             const task::Progress &progress = {});

/// The spectra of fields by one plan; each field is released as soon as its samples are
/// transformed.
render::EngineSpectra spectraOf(ShadedFields fields, const plan::RenderPlan &plan,
                                const task::Progress &progress = {});

/// Makes an engine for the channels of a look, see `spectraOf`.
std::shared_ptr<render::CpuEngine> makeEngine(ShadedFields channels, const plan::RenderPlan &plan,
                                              const task::Progress &progress = {});

/// Computes what the scene's light needs, plans and prepares. *Throws* Error{outOfMemory},
/// Cancelled.
PreparedEngine prepareEngine(EngineRequest request, const task::Progress &progress = {});

/// Whether a picture of a scene, whose pixel may not be the planned one, had better be made by
/// another engine than sums along the view.
bool needsASpectrum(const PreparedEngine &prepared, const scene::Scene &scene);

/// What is known of the error of whole pictures before it is measured: the plan's bound. Not set
/// for the sum of layers, and for fields that are coarser than the study.
std::optional<error::StatedError> boundOf(const PreparedEngine &prepared,
                                          const scene::ImageDefinition &image);

/// Whether the measured error of a picture exceeds a tolerance that its plan keeps for the whole
/// volume, so that another plan, or one kernel for every frequency, may help.
bool missesTolerance(const PreparedEngine &prepared, const error::StatedError &measured,
                     error::Shown shown, const scene::Scene &scene);
/// How much of the prepared fields a camera shows.
error::Shown shownOf(const PreparedEngine &prepared, const scene::Camera &camera);

/// Whether frames choose the widths of their kernels, within the tolerance of the whole volume.
inline bool choosesWidths(const PreparedEngine &prepared) {
    return prepared.plan.adaptiveError > 0.0;
}

/// The same engine with one kernel for every frequency: slower, and more accurate.
PreparedEngine withOneWidth(const PreparedEngine &prepared);

/// The same engine without its lights; its error is at most what it was with them.
PreparedEngine withoutLight(const PreparedEngine &prepared);

} // namespace pellucid::prepare
