// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/render_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/fourier/transforms/padded_size.h"
#include "core/plan/cost_model.h"
#include "core/plan/kernel_candidates.h"
#include "core/plan/reasons.h"
#include "core/task/error.h"

namespace pellucid::plan {

namespace {

namespace because = task::because;

// A slice grid, and the error of the tails that fold back into it.
struct PlannedGrid {
    SliceGrid grid;
    FieldOfView fieldOfView;
    double folded = 0.0;
    double cells() const { return double(grid.columns) * grid.rows; }
};

// The slice grids worth trying, smallest first.
std::vector<PlannedGrid> planGrids(const scene::Scene &scene,
                                   std::span<const field::Summary> fields, double errorFactor) {
    const scene::Camera &camera = scene.camera;
    FieldOfView fieldOfView;
    for (const field::Summary &field : fields)
        fieldOfView.spreads.push_back(field.energy.spread);
    std::vector<PlannedGrid> grids;
    for (const double share : {0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}) {
        fieldOfView.aliasingLimit = share * scene.tolerance / errorFactor;
        const SliceGrid grid = sliceGrid(camera, fieldOfView, fields.front().lattice, scene.image);
        if (!grids.empty() && grid == grids.back().grid)
            continue;
        double folded = 0.0;
        for (const auto &spread : fieldOfView.spreads)
            folded = std::max(
                folded, predictFoldedTails(scene.image, camera, grid.columns, grid.rows, *spread));
        grids.push_back({grid, fieldOfView, errorFactor * folded});
    }
    return grids;
}

// The smallest share of any field.
double imageShare(const scene::Camera &camera, std::span<const field::Summary> fields) {
    double share = 1.0;
    for (const field::Summary &field : fields)
        share = std::min(share, shareInImage(camera, *field.energy.spread));
    return share;
}

template <class T>
std::vector<T> choices(const std::optional<T> &fixed, std::initializer_list<T> planned) {
    return fixed ? std::vector<T>{*fixed} : std::vector<T>(planned);
}

task::Reason reasonFor(const RenderPlan &plan, const scene::Scene &scene, bool overBudget) {
    const bool meets = plan.predictedError <= scene.tolerance;
    std::optional<task::Reason> fixed;
    const scene::Interpolation &wanted = scene.interpolation;
    for (const auto &[given, what] : {std::pair(wanted.kernel.has_value(), because::kernel),
                                      std::pair(wanted.padding.has_value(), because::padding),
                                      std::pair(wanted.storage.has_value(), because::storage)})
        if (given)
            fixed = fixed ? because::both(*fixed, what) : what;
    if (!fixed)
        return meets        ? because::fastest
               : overBudget ? because::mostAccurateThatFits
                            : because::mostAccurate;
    return meets        ? because::fastestWith(*fixed)
           : overBudget ? because::mostAccurateThatFitsWith(*fixed)
                        : because::mostAccurateWith(*fixed);
}

// The search for the best plan: kernels, storages, paddings and slice grids, each tried in turn.
class Planner {
public:
    Planner(const scene::Scene &scene, std::span<const field::Summary> fields,
            const Composition &composition, const Budget &budget)
        : m_scene(scene), m_fields(fields), m_composition(composition),
          m_errorFactor(composition.errorFactor()), m_budget(budget),
          m_kernels(
              choices<fourier::KernelChoice>(scene.interpolation.kernel, {{leastAliasing, 3},
                                                                          {leastAliasing, 4},
                                                                          {leastAliasing, 5},
                                                                          {leastAliasing, 6},
                                                                          {leastAliasing, 7}})),
          m_paddings(
              choices(scene.interpolation.padding, {leastPadding, 1.375, 1.5, 1.625, 1.75, 2.0})),
          m_storages(choices(scene.interpolation.storage,
                             {fourier::Storage::binary16, fourier::Storage::float32})),
          m_axes{KernelCandidates(0, fields, cueOf(scene)),
                 KernelCandidates(1, fields, cueOf(scene)),
                 KernelCandidates(2, fields, cueOf(scene))},
          m_grids(planGrids(scene, fields, m_errorFactor)),
          m_imageShare(imageShare(scene.camera, fields)),
          m_isAdaptive(!scene.interpolation.isUniform &&
                       widthsPay(m_grids.front().grid, scene.camera, fields.front().lattice,
                                 leastPadded(), composition.pictures)) {
        // Half of the squared error is for narrower kernels, if it can be. Four fifths of the
        // tolerance for the plan gave the same frames within a tenth; with all of it, frames took
        // up to twice as long.
        if (m_isAdaptive)
            m_limits.push_back(std::sqrt(0.5) * scene.tolerance);
        m_limits.push_back(scene.tolerance);
        // Wide kernels and float cells need the least padding.
        if (leastPreparation() > m_composition.pictures * timeOf(m_kernels.back())) {
            std::reverse(m_kernels.begin(), m_kernels.end());
            std::reverse(m_storages.begin(), m_storages.end());
        }
    }

    // The first storage that meets the tolerance: binary16, because float cells take twice the
    // memory, unless preparation is most of the time. The first searches skip kernels that no
    // padding makes good enough, because making a kernel takes milliseconds.
    RenderPlan plan() {
        for (const auto storage : m_storages)
            for (const double limit : m_limits)
                if (search(storage, limit))
                    return finished();
        for (const auto storage : m_storages)
            search(storage, m_scene.tolerance, true);
        requirePlan();
        return finished();
    }

private:
    // Returns whether a plan predicts at most `limit`.
    bool search(fourier::Storage storage, double limit, bool thorough = false) {
        m_limit = limit;
        for (const auto &choice : m_kernels)
            if (mayBeFaster(choice, storage) && (thorough || !isHopeless(choice, storage)))
                considerPaddings(choice, storage);
        return !std::isinf(m_bestTime);
    }
    RenderPlan finished() const {
        RenderPlan plan = *m_best;
        plan.reason = reasonFor(plan, m_scene, m_isOverBudget);
        plan.isAdaptive = m_isAdaptive;
        return plan;
    }

    static constexpr auto leastAliasing = fourier::KernelFamily::leastAliasing;
    using Levels = std::array<std::size_t, 3>; // of padding, per axis

    struct Layout {
        fourier::SpectrumLayout spectrum;
        std::array<AxisError, 3> errors;
    };

    static LinearCue cueOf(const scene::Scene &scene) {
        return scene.shading.cue.hasMoments() ? LinearCue::present : LinearCue::none;
    }

    Layout layoutAt(const fourier::KernelChoice &choice, fourier::Storage storage,
                    const Levels &level) {
        const KernelCandidate &i = m_axes[0].at(choice, m_paddings[level[0]]),
                              &j = m_axes[1].at(choice, m_paddings[level[1]]),
                              &k = m_axes[2].at(choice, m_paddings[level[2]]);
        return {{{i.kernel, j.kernel, k.kernel},
                 m_fields.front().support, // the box of all fields
                 {i.padded, j.padded, k.padded},
                 storage},
                {i.error, j.error, k.error}};
    }

    // The largest weight of any field.
    CueWeight weightOf(const fourier::SpectrumLayout &layout) const {
        CueWeight worst;
        for (const field::Summary &field : m_fields) {
            const CueWeight weight = cueWeight(
                m_scene.shading.cue, field.lattice,
                field.depthRadiusMm.value_or(field.lattice.radiusMm()), layout, field.energy);
            worst.aliases = std::max(worst.aliases, weight.aliases);
            for (std::size_t d = 0; d < worst.moments.size(); ++d)
                worst.moments[d] = std::max(worst.moments[d], weight.moments[d]);
        }
        return worst;
    }
    double relativeError(const Layout &layout) const {
        const CueWeight weight = weightOf(layout.spectrum);
        double worst = 0.0;
        for (const field::Summary &field : m_fields)
            worst = std::max(worst, predictRelativeError(layout.errors, layout.spectrum.storage,
                                                         field.energy, m_imageShare, weight));
        return m_errorFactor * worst;
    }
    // The least time of a frame.
    double timeOf(const fourier::KernelChoice &choice) const {
        return m_grids.front().cells() * timeInCache(choice.width, m_storages.front());
    }
    // One spectrum counts, because a frame reads a slice of each.
    double leastPreparation() const { return prepareTime(leastPadded()); }
    volume::GridSize leastPadded() const {
        volume::GridSize padded = m_fields.front().support.size();
        for (int *const side : {&padded.i, &padded.j, &padded.k})
            *side = fourier::paddedSize(*side, m_paddings.front());
        return padded;
    }
    // More taps and wider cells cost time that nothing else can save, and so does the search.
    bool mayBeFaster(const fourier::KernelChoice &choice, fourier::Storage storage) const {
        return leastPreparation() +
                   m_composition.pictures * m_grids.front().cells() *
                       timeInCache(choice.width, storage) +
                   searchTime <
               m_bestTime;
    }
    bool isHopeless(const fourier::KernelChoice &choice, fourier::Storage storage) {
        const std::size_t most = m_paddings.size() - 1;
        const double minFolded =
            std::min_element(m_grids.begin(), m_grids.end(), [](const auto &a, const auto &b) {
                return a.folded < b.folded;
            })->folded;
        return std::hypot(relativeError(layoutAt(choice, storage, {most, most, most})), minFolded) >
               m_limit;
    }

    // Starts with the least padding and adds to one axis at a time.
    void considerPaddings(const fourier::KernelChoice &choice, fourier::Storage storage) {
        for (Levels level{};;) {
            const Layout layout = layoutAt(choice, storage, level);
            if (!layout.spectrum.addressable()) {
                m_isOverBudget = true;
                return;
            }
            if (!considerGrids(layout) || !addPadding(layout.errors, level))
                return;
        }
    }

    // Adds padding to the axis with the strongest aliases. Returns false if all axes have the most.
    bool addPadding(const std::array<AxisError, 3> &errors, Levels &level) const {
        int worst = -1;
        for (int d = 0; d < 3; ++d)
            if (level[d] + 1 < m_paddings.size() &&
                (worst < 0 || strength(errors[d]) > strength(errors[worst])))
                worst = d;
        if (worst < 0)
            return false;
        ++level[std::size_t(worst)];
        return true;
    }
    // An axis's aliases where they are strongest.
    static double strength(const AxisError &error) {
        double most = 0.0;
        for (const BlockAmplitudes &block : error.blocks)
            most = std::max(most, block.aliases);
        return most;
    }

    // Returns whether more padding may lead to a better plan. It cannot if this layout does not fit
    // in memory, or meets the tolerance with the smallest grid already.
    bool considerGrids(const Layout &layout) {
        bool fits = false;
        const double layoutError = relativeError(layout);
        for (const PlannedGrid &planned : m_grids) {
            const std::size_t bytes = bytesOf(layout.spectrum, planned.grid);
            m_minBytes = std::min(m_minBytes, bytes);
            if (bytes > m_budget.bytes) {
                m_isOverBudget = true;
                break; // wider grids take more
            }
            fits = true;
            if (considerPlan(layout, layoutError, planned, bytes))
                return &planned != &m_grids.front(); // wider grids take longer
        }
        return fits;
    }

    // While the last spectrum is prepared, the others exist already.
    std::size_t bytesOf(const fourier::SpectrumLayout &layout, const SliceGrid &grid) const {
        return layout.peakBytes() + (m_fields.size() - 1) * layout.bytes() +
               frameBytes(grid, m_scene.camera, m_composition.images);
    }

    // Keeps the plan if it is the best so far: the fastest within the tolerance, or, if there is
    // none yet, the most accurate. Returns whether it is within the tolerance.
    bool considerPlan(const Layout &layout, double layoutError, const PlannedGrid &planned,
                      std::size_t bytes) {
        const double predicted = std::hypot(layoutError, planned.folded);
        const double time =
            prepareTime(layout.spectrum.padded) +
            m_composition.pictures *
                frameTime(planned.grid, m_scene.camera, m_fields.front().lattice, layout.spectrum);
        const bool meets = predicted <= m_limit, unmet = std::isinf(m_bestTime);
        if (meets ? time < m_bestTime : unmet && (!m_best || predicted < m_best->predictedError)) {
            m_best = RenderPlan{layout.spectrum, planned.fieldOfView, predicted, bytes};
            if (meets)
                m_bestTime = time;
        }
        return meets;
    }

    void requirePlan() const {
        if (m_best)
            return;
        if (m_minBytes == std::numeric_limits<std::size_t>::max())
            throw task::Error(task::ErrorCode::outOfMemory, because::projectionNeedsTooManyCells);
        throw task::Error(
            task::ErrorCode::outOfMemory,
            because::projectionNeedsMemory((m_minBytes >> 20) + 1, m_budget.bytes >> 20));
    }

    const scene::Scene &m_scene;
    std::vector<double> m_limits; ///< of the error, in the order in which they are tried
    double m_limit = 0.0;         ///< the error that a plan may predict in this search
    std::span<const field::Summary> m_fields; ///< on one lattice, in one box
    Composition m_composition;
    double m_errorFactor;
    Budget m_budget;
    std::vector<fourier::KernelChoice> m_kernels;
    std::vector<double> m_paddings;
    std::vector<fourier::Storage> m_storages;
    std::array<KernelCandidates, 3> m_axes;
    std::vector<PlannedGrid> m_grids;
    double m_imageShare; ///< share of the projection's energy in the image
    bool m_isAdaptive;

    std::optional<RenderPlan> m_best;
    /// The least time for all pictures that a plan within the tolerance takes.
    double m_bestTime = std::numeric_limits<double>::infinity();
    bool m_isOverBudget = false; ///< something did not fit
    std::size_t m_minBytes = std::numeric_limits<std::size_t>::max();
};

} // namespace

RenderPlan planRender(const scene::Scene &scene, const field::Summary &field,
                      const Budget &budget) {
    return planRender(scene, {&field, 1}, Composition{}, budget);
}

namespace {

// Errors are predicted for the image without amplified detail, whose factor raises them at most by
// its gain, because it is nowhere below 1.
RenderPlan withDetail(RenderPlan plan, const scene::ImageDefinition &image) {
    const double gain = scene::detailGain(image);
    plan.predictedError *= gain;
    plan.image = image;
    return plan;
}

} // namespace

void requireDetailFits(const scene::Scene &scene, std::span<const field::Summary> fields) {
    for (const field::Summary &field : fields)
        if (scene.image.detail > 0.0 && scene.image.detailMm > field.lattice.radiusMm())
            throw task::Error(task::ErrorCode::usage, task::because::detailIsLargerThanTheVolume);
}

RenderPlan planRender(const scene::Scene &scene, std::span<const field::Summary> fields,
                      const Composition &composition, const Budget &budget) {
    scene::validate(scene);
    requireDetailFits(scene, fields);
    scene::Scene plain = scene;
    plain.tolerance /= scene::detailGain(scene.image);
    return withDetail(Planner(plain, fields, composition, budget).plan(), scene.image);
}

void adaptWidths(RenderPlan &plan, const scene::Scene &scene,
                 std::span<const field::Summary> fields) {
    // Both for the image without amplified detail.
    const double gain = scene::detailGain(scene.image);
    const double tolerance = scene.tolerance / gain, error = plan.predictedError / gain;
    if (!plan.isAdaptive || plan.spectrum.width() < 2 || error >= tolerance)
        return;
    const double rest = std::sqrt(tolerance * tolerance - error * error);
    plan.adaptiveError = gain * rest;
    plan.adaptiveTolerance = rest * std::sqrt(imageShare(scene.camera, fields));
    plan.predictedError = scene.tolerance;
}

RenderPlan withOneWidth(RenderPlan plan) {
    plan.predictedError = std::sqrt(std::max(0.0, plan.predictedError * plan.predictedError -
                                                      plan.adaptiveError * plan.adaptiveError));
    plan.adaptiveError = plan.adaptiveTolerance = 0.0;
    return plan;
}

} // namespace pellucid::plan
