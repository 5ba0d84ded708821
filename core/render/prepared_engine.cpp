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

double lostDetail(const classify::DensityField &field, const classify::DensityField &means) {
    const double all = energy(field.values);
    const double kept = energy(means.values) * (means.values.lattice().cellVolumeMm3() /
                                                field.values.lattice().cellVolumeMm3());
    return all > 0.0 ? std::sqrt(std::max(0.0, 1.0 - kept / all)) : 0.0;
}

FittingPlan planWithin(const Scene &scene, std::span<const classify::DensityField> fields,
                       std::span<const FieldSummary> summaries, const Budget &budget,
                       const task::Progress &progress) {
    validate(scene);
    const int channels = int(fields.size());
    // An image too large for the memory stays so, however coarse the field.
    const SliceGrid least = sliceGrid(scene.camera, {{summaries.front().energy.spread}, 1.0},
                                      summaries.front().lattice, scene.image);
    const std::size_t frame = std::size_t(channels) * frameBytes(least, scene.camera);
    if (frame > budget.bytes)
        throw task::Error(task::ErrorCode::outOfMemory,
                          fmt::format("an image of {} x {} pixels needs {} MB, {} MB are allowed",
                                      scene.camera.width, scene.camera.height, (frame >> 20) + 1,
                                      budget.bytes >> 20));
    try {
        return {planRender(scene, summaries, channels, budget), {}, 1};
    } catch (const task::Error &error) {
        if (error.code() != task::ErrorCode::outOfMemory)
            throw;
        const volume::GridSize n = fields.front().values.lattice().size();
        const int longest = std::max({n.i, n.j, n.k});
        for (int reduction = 2; longest / reduction >= fewestSamples; ++reduction) {
            std::vector<classify::DensityField> reduced;
            std::size_t held = 0; // samples need memory too
            double lost = 0.0;
            for (const classify::DensityField &field : fields) {
                progress.check();
                reduced.push_back(
                    classify::coarseField(field, (longest + reduction - 1) / reduction));
                held += reduced.back().values.bytes();
                lost = std::max(lost, lostDetail(field, reduced.back()));
            }
            if (held >= budget.bytes)
                continue;
            try {
                FittingPlan fitting{
                    planRender(scene, summarise(reduced), channels, {budget.bytes - held}),
                    std::move(reduced), reduction};
                RenderPlan &plan = fitting.plan;
                plan.predictedError = std::hypot(plan.predictedError, lost);
                plan.predictedMaximum = std::max(plan.predictedMaximum, lost);
                plan.bytes += held;
                const volume::GridSize size = fitting.reducedFields.front().values.lattice().size();
                plan.reason = fmt::format("means, {} x {} x {} in place of {} x {} x {}: more does "
                                          "not fit the memory",
                                          size.i, size.j, size.k, n.i, n.j, n.k);
                return fitting;
            } catch (const task::Error &smaller) {
                if (smaller.code() != task::ErrorCode::outOfMemory)
                    throw;
            }
        }
        throw;
    }
}

std::shared_ptr<CpuEngine> makeEngine(std::span<const classify::DensityField> channels,
                                      const classify::Color &color, const RenderPlan &plan,
                                      const task::Progress &progress) {
    std::vector<std::shared_ptr<const fourier::Spectrum>> spectra;
    for (std::size_t c = 0; c < channels.size(); ++c)
        spectra.push_back(std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(channels[c].values, plan.spectrum,
                                       progress.part(double(c) / double(channels.size()),
                                                     double(c + 1) / double(channels.size())))));
    auto engine = std::make_shared<CpuEngine>(std::move(spectra), plan.room);
    if (channels.size() == 1)
        engine->setShares({{color.red, color.green, color.blue}});
    else
        engine->setShares({{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
    return engine;
}

PreparedEngine prepareEngine(const Scene &scene, const classify::ShownFields &fields,
                             const Budget &budget, const task::Progress &progress) {
    FittingPlan fitting =
        planWithin(scene, fields.channels, summarise(fields.channels), budget, progress);
    const auto &sources = fitting.reducedFields.empty() ? fields.channels : fitting.reducedFields;
    auto engine = makeEngine(sources, fields.color, fitting.plan, progress);
    const std::size_t bytes = engine->bytes();
    return {std::move(engine), std::move(fitting.plan), bytes};
}

} // namespace pellucid::render
