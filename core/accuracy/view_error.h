// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/accuracy/coarse_fields.h"
#include "core/plan/render_plan.h"
#include "core/render/projection_engine.h"

namespace pellucid::accuracy {

/// The predicted error of one picture.
struct PictureError {
    /// The relative L2 error. From 1 on the picture may be nothing but error, for example an empty
    /// part.
    double relative = 0.0;
    bool isWhole = true; ///< no part of the fields is beside the picture
};

/// Predicts the error of single pictures from a plan and its fields. It keeps the fields as coarse
/// blocks, and the aliases of each block under the plan's kernels.
class ViewErrorModel {
public:
    /// *Shape*: one summary for each field of the plan.
    ViewErrorModel(const plan::RenderPlan &plan, std::span<const plan::FieldSummary> fields);

    /// The error of a picture made by an engine of this plan, with cue and light. It is predicted
    /// from the projected energies and aliases of this view, in the picture's window. For a whole
    /// picture in which no more fields add up than were planned, it is at most the plan's bound.
    PictureError errorOf(const picture::ProjectionImage &picture, const scene::Camera &camera,
                         const scene::ImageDefinition &image, const render::EngineParts &engine,
                         const shading::Shading &shading) const;

private:
    CoarseFields m_fields;
    plan::FieldOfView m_fieldOfView;
    double m_bound;
    int m_together; ///< see plan::Composition
};

} // namespace pellucid::accuracy
