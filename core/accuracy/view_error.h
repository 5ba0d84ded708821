// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/accuracy/coarse_fields.h"
#include "core/plan/render_plan.h"
#include "core/render/projection_engine.h"

namespace pellucid::accuracy {

/// The predicted error of one picture.
struct PictureError {
    /// The relative L2 error. From 1 on the picture may be nothing but error, as of a part in which
    /// nothing is shown.
    double relative = 0.0;
    bool isWhole = true; ///< nothing of the fields lies beside the picture
};

/// Predicts the error of single pictures from a plan and its fields: it keeps coarse fields and the
/// aliases that the plan's kernels make of each of their blocks.
class ViewErrorModel {
public:
    /// *Shape*: one summary for each field of the plan.
    ViewErrorModel(const plan::RenderPlan &plan, std::span<const plan::FieldSummary> fields);

    /// The error of a picture that an engine of the plan made, with cue and light, with the
    /// energies and the aliases as they are seen from there, in the window that it has. For a whole
    /// picture of one field a channel it is never more than the plan's bound, which is for whole
    /// pictures only.
    PictureError errorOf(const picture::ProjectionImage &picture, const scene::Camera &camera,
                         const scene::ImageDefinition &image, const render::EngineParts &engine,
                         const shading::Shading &shading) const;

private:
    CoarseFields m_fields;
    plan::FieldOfView m_fieldOfView;
    double m_bound;
};

} // namespace pellucid::accuracy
