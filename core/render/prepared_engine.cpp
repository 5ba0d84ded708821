// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/prepared_engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/classify/coarse_field.h"
#include "core/task/error.h"

namespace pellucid::render {

namespace {

constexpr int fewestSamples = 32;

double energy(const volume::Volume &field) {
    return field.visit([](auto samples) {
        double sum = 0.0;
        for (const auto f : samples)
            sum += double(f) * double(f);
        return sum;
    });
}

} // namespace

FittingPlan planWithin(const Scene &scene, const classify::DensityField &field,
                       const FieldSummary &summary, const Budget &budget,
                       const task::Progress &progress) {
    validate(scene);
    // An image too large for the memory stays so, however coarse the field.
    const SliceGrid least =
        sliceGrid(scene.camera, {summary.energy.spread, 1.0}, summary.lattice, scene.image);
    const std::size_t frame = frameBytes(least, scene.camera);
    if (frame > budget.bytes)
        throw task::Error(task::ErrorCode::outOfMemory,
                          fmt::format("an image of {} x {} pixels needs {} MB, {} MB are allowed",
                                      scene.camera.width, scene.camera.height, (frame >> 20) + 1,
                                      budget.bytes >> 20));
    try {
        return {planRender(scene, summary, budget), std::nullopt, 1};
    } catch (const task::Error &error) {
        if (error.code() != task::ErrorCode::outOfMemory)
            throw;
        const volume::GridSize n = field.values.lattice().size();
        const int longest = std::max({n.i, n.j, n.k});
        for (int reduction = 2; longest / reduction >= fewestSamples; ++reduction) {
            progress.check();
            auto coarse = classify::coarseField(field, (longest + reduction - 1) / reduction);
            // Samples need memory too.
            const std::size_t held = coarse.values.bytes();
            if (held >= budget.bytes)
                continue;
            try {
                FittingPlan fitting{planRender(scene, summarise(coarse), {budget.bytes - held}),
                                    std::nullopt, reduction};
                const double all = energy(field.values);
                const double kept =
                    energy(coarse.values) * (coarse.values.lattice().cellVolumeMm3() /
                                             field.values.lattice().cellVolumeMm3());
                const double lost = all > 0.0 ? std::sqrt(std::max(0.0, 1.0 - kept / all)) : 0.0;
                RenderPlan &plan = fitting.plan;
                plan.predictedError = std::hypot(plan.predictedError, lost);
                plan.predictedMaximum = std::max(plan.predictedMaximum, lost);
                plan.bytes += held;
                const volume::GridSize size = coarse.values.lattice().size();
                plan.reason = fmt::format("means, {} x {} x {} in place of {} x {} x {}: more does "
                                          "not fit the memory",
                                          size.i, size.j, size.k, n.i, n.j, n.k);
                fitting.reducedField = std::move(coarse);
                return fitting;
            } catch (const task::Error &smaller) {
                if (smaller.code() != task::ErrorCode::outOfMemory)
                    throw;
            }
        }
        throw;
    }
}

PreparedEngine prepareEngine(const Scene &scene, const classify::DensityField &field,
                             const Budget &budget, const task::Progress &progress) {
    FittingPlan fitting = planWithin(scene, field, summarise(field), budget, progress);
    const auto &source = fitting.reducedField ? *fitting.reducedField : field;
    auto spectrum = std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(source.values, fitting.plan.spectrum, progress));
    return {std::make_shared<CpuEngine>(std::move(spectrum), fitting.plan.room),
            std::move(fitting.plan)};
}

} // namespace pellucid::render
