// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "core/render/cpu_engine.h"

namespace pellucid::render {

/// A plan that fits the memory, if need be for a field of fewer samples.
struct FittingPlan {
    RenderPlan plan;
    /// The field to render in place of the original: means of up to `reduction` samples an axis.
    std::optional<classify::DensityField> reducedField;
    int reduction = 1;
};

/// What fits is used; what does not is reduced in this order: storage, padding, resolution. The
/// predicted error of a reduced field counts the detail that the means leave out, as its share of
/// the field's energy: projections, which average too, lose less. *Throws* Error{outOfMemory} if
/// 32 samples a side do not fit either, or if it is the image that is too large; Cancelled.
FittingPlan planWithin(const Scene &scene, const classify::DensityField &field,
                       const FieldSummary &summary, const Budget &budget,
                       const task::Progress &progress = {});

/// An engine, ready to render.
struct PreparedEngine {
    std::shared_ptr<CpuEngine> engine;
    RenderPlan plan;
};

/// Plans within the budget and prepares the spectrum. *Throws* Error{outOfMemory}, Cancelled.
PreparedEngine prepareEngine(const Scene &scene, const classify::DensityField &field,
                             const Budget &budget, const task::Progress &progress = {});

} // namespace pellucid::render
