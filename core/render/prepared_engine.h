// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/classify/shown_fields.h"
#include "core/render/cpu_engine.h"
#include "core/render/shaded_fields.h"
#include "core/render/view_error.h"

namespace pellucid::render {

/// A plan that fits the memory, if need be for fields of fewer samples.
struct FittingPlan {
    RenderPlan plan;
    /// What to render in place of the originals: means of up to `reduction` samples an axis.
    std::optional<ShadedFields> reduced;
    int reduction = 1;
};

/// What fits is used; what does not is reduced in this order: storage, padding, resolution. The
/// predicted error of a reduced field counts the detail that the means leave out, as its share of
/// the field's energy: projections, which average too, lose less. *Shape*: the fields' summaries.
/// *Throws* Error{outOfMemory} if 32 samples a side do not fit either, or if it is the image that
/// is too large; Cancelled.
FittingPlan planWithin(const Scene &scene, const ShadedFields &fields,
                       std::span<const FieldSummary> summaries, const Budget &budget,
                       const task::Progress &progress = {});

/// The share of a field's energy, as a relative L2, that means of blocks leave out.
double lostDetail(const classify::DensityField &field, const classify::DensityField &means);

/// An engine, ready to render.
struct PreparedEngine {
    std::shared_ptr<ProjectionEngine> engine;
    RenderPlan plan;
    std::size_t bytes = 0; ///< of its spectra
    bool takesLight = false;
    /// Tells the error of single pictures; none where detail is lost wherever one looks from.
    std::shared_ptr<const ViewErrorModel> viewError;
};

/// An engine for the channels of a look whose spectra, of one layout, are prepared by a plan.
std::shared_ptr<CpuEngine> makeEngine(const ShadedFields &channels, const classify::Color &color,
                                      const RenderPlan &plan, const task::Progress &progress = {});

/// Makes what the scene's light needs, plans within the budget and prepares the spectra. `scale`:
/// of the volume, if the fields are of a coarser one. *Throws* Error{outOfMemory}, Cancelled.
PreparedEngine prepareEngine(const Scene &scene, const classify::ShownFields &fields,
                             const Budget &budget, const task::Progress &progress = {},
                             const std::optional<shading::ShadingScale> &scale = std::nullopt);

/// The same engine after the lights went out; its error is what it was with them, at most.
PreparedEngine withoutLight(const PreparedEngine &prepared);

} // namespace pellucid::render
