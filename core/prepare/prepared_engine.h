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

/// A plan that fits the memory, if need be for fields of fewer samples.
struct FittingPlan {
    plan::RenderPlan plan;
    /// What to render in place of the originals: means of up to `reduction` samples an axis.
    std::optional<ShadedFields> reduced;
    int reduction = 1;
};

/// What fits is used; what does not is reduced in this order: storage, padding, resolution. The
/// predicted error of a reduced field counts the detail that the means leave out, as its share of
/// the field's energy: projections, which average too, lose less. *Shape*: the fields' summaries.
/// *Throws* Error{outOfMemory} if 32 samples a side do not fit either, or if it is the image that
/// is too large; Cancelled.
FittingPlan planWithin(const scene::Scene &scene, const ShadedFields &fields,
                       std::span<const plan::FieldSummary> summaries, const plan::Budget &budget,
                       const task::Progress &progress = {});

/// The share of a field's energy, as a relative L2, that means of blocks leave out.
double lostDetail(const classify::DensityField &field, const classify::DensityField &means);

/// An engine, ready to render.
struct PreparedEngine {
    std::shared_ptr<render::ProjectionEngine> engine;
    plan::RenderPlan plan;
    std::size_t bytes = 0; ///< of its spectra
    bool takesLight = false;
    /// Tells the error of single pictures of the fields that were prepared; none where the plan has
    /// joined samples, which its own error counts.
    std::shared_ptr<const accuracy::ViewErrorModel> viewError;
    /// Whether those fields are coarser than the study. Then `detailLoss` tells the error that
    /// results; it is null until that has been computed.
    bool isCoarse = false;
    std::shared_ptr<const accuracy::DetailLoss> detailLoss;
    plan::SpectrumOf of = plan::SpectrumOf::look;
};

/// An engine for the channels of a look whose spectra, of one layout, are prepared by a plan.
std::shared_ptr<render::CpuEngine> makeEngine(const ShadedFields &channels,
                                              const classify::Color &color,
                                              const plan::RenderPlan &plan,
                                              const task::Progress &progress = {});

/// Plans within the budget and prepares the spectra. *Throws* Error{outOfMemory}, Cancelled.
PreparedEngine prepareEngine(const scene::Scene &scene, const ShadedFields &fields,
                             const classify::Color &color, const plan::Budget &budget,
                             const task::Progress &progress = {});
/// Makes what the scene's light needs first. `scale`: of the volume, if the fields are of a coarser
/// one. *Throws* as above.
PreparedEngine prepareEngine(const scene::Scene &scene, const classify::ShownFields &fields,
                             const plan::Budget &budget, const task::Progress &progress = {},
                             const std::optional<shading::ShadingScale> &scale = std::nullopt);

/// The relative L2 error of a picture against that of the study. No value until the loss of detail
/// has been computed.
std::optional<double> errorOf(const PreparedEngine &prepared,
                              const picture::ProjectionImage &picture, const scene::Camera &camera,
                              const scene::ImageDefinition &image, const shading::Shading &shading);
/// The same for a whole picture whose error against the fields that were prepared is known.
std::optional<double> errorAgainstStudy(const PreparedEngine &prepared, double ofFields,
                                        const shading::Shading &shading);

/// The same engine after the lights went out; its error is what it was with them, at most.
PreparedEngine withoutLight(const PreparedEngine &prepared);

} // namespace pellucid::prepare
