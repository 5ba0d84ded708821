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
    // A slice too large for any memory stays so, however coarse the field.
    sliceGrid(scene.camera, {summary.energy.spread}, summary.lattice, scene.image);
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
                plan.reason = fmt::format("means of {0} x {0} x {0} samples: more does not fit the "
                                          "memory; of them {1}",
                                          reduction, plan.reason);
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
