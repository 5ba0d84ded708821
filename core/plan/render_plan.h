// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/field/summary.h"
#include "core/fourier/spectrum.h"
#include "core/plan/error_prediction.h"
#include "core/plan/reasons.h"
#include "core/plan/slice_grid.h"
#include "core/scene/scene.h"
#include "core/task/reason.h"

namespace pellucid::plan {

/// The memory that a plan may use.
struct Budget {
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
    /// Whether `core/prepare` chooses a plan that fits. If not, it refuses one that does not:
    /// pictures are then the same whatever the memory.
    bool decides = true;
};

/// How an image of a scene is computed, what it costs, and how far from the exact integral it will
/// be. Pure: made and tested without rendering.
struct RenderPlan {
    fourier::SpectrumLayout spectrum;
    FieldOfView fieldOfView;
    /// Relative L2 error of the image, predicted from the fields.
    double predictedError = 0.0;
    /// The largest number of bytes held at once by the spectra, their preparation and the frames of
    /// the planned camera.
    std::size_t bytes = 0;
    /// Why this plan was chosen: one line for the user.
    task::Reason reason = task::because::mostAccurate;
    /// Whether frames may choose the widths of their kernels, see `widths::AdaptiveWidths`; they do
    /// if `adaptiveError` is above 0.
    bool isAdaptive = false;
    /// The part of `predictedError` that frames may make by narrower kernels; 0: one kernel reads
    /// every frequency.
    double adaptiveError = 0.0;
    /// The same, relative to the whole projection, of which the image may show a part.
    double adaptiveTolerance = 0.0;
    scene::ImageDefinition image; ///< for which these are
};

/// The same plan with one kernel for every frequency.
RenderPlan withOneWidth(RenderPlan plan);

/// The kernel, padding of each axis and slice grid that take the least time for all pictures,
/// preparation included, with a predicted error within the scene's tolerance. Cells are binary16 if
/// these meet it or, where preparation takes most of the time, float. If the plan is adaptive, it
/// takes half of the squared tolerance where it can; `adaptWidths` spends the rest. If no plan is
/// within the tolerance, or none of those fits the budget: the most accurate that fits.
/// Values that the scene's `interpolation` sets are not changed. *Throws* Error{outOfMemory} if
/// nothing fits the budget, Error{usage} if the scene is invalid.
RenderPlan planRender(const scene::Scene &scene, const field::Summary &field,
                      const Budget &budget = {});

/// How the images of fields make a picture, and how many pictures.
struct Composition {
    int images = 1; ///< transforms in a frame
    /// The largest number of fields that add up in a channel of a picture that the plan's error is
    /// for. Their errors may be alike where their images are not: without negative samples, the
    /// relative error of n of them is at most sqrt(n) times that of the worst. Layers whose weights
    /// move are planned one by one; the error of their sum is measured.
    int together = 1;
    /// How many pictures are made from one preparation. Default: the window, about ten seconds of
    /// turning.
    int pictures = 500;
    /// The error of a picture over that of its worst field.
    double errorFactor() const { return std::sqrt(double(together)); }
};

/// The same for fields whose spectra share a layout, so that a slice can be their weighted sum. The
/// errors are those of the worst field, for the composition; the bytes are the sum.
RenderPlan planRender(const scene::Scene &scene, std::span<const field::Summary> fields,
                      const Composition &composition, const Budget &budget = {});

/// *Throws* Error{usage} if detail is larger than a field: the filter would need room around the
/// projection many times its size.
void requireDetailFits(const scene::Scene &scene, std::span<const field::Summary> fields);

/// If the plan is adaptive, spends the rest of the tolerance on narrower kernels and on leaving
/// frequencies out. Each frame measures where. *Shape*: the fields of the plan.
void adaptWidths(RenderPlan &plan, const scene::Scene &scene,
                 std::span<const field::Summary> fields);

} // namespace pellucid::plan
