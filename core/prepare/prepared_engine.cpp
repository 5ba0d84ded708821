// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/prepared_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/classify/coarse_field.h"
#include "core/task/error.h"

namespace pellucid::prepare {

namespace {

constexpr int minSamples = 32;

double energy(const classify::DensityField &field) {
    const volume::VoxelBox &box = field.support;
    const int columns = box.size().i;
    std::vector<float> buffer(columns);
    double sum = 0.0;
    for (int k = box.lo.k; k < box.hi.k; ++k)
        for (int j = box.lo.j; j < box.hi.j; ++j) {
            const float *const row = field.values.row({box.lo.i, j, k}, columns, buffer.data());
            for (int i = 0; i < columns; ++i)
                sum += double(row[i]) * double(row[i]);
        }
    return sum;
}

// The detail that averages lose: the energy of the differences between samples and their means,
// relative to the field's.
double lostDetail(const classify::DensityField &field, const classify::DensityField &means) {
    const double all = energy(field);
    const double kept = energy(means) * (means.values.lattice().cellVolumeMm3() /
                                         field.values.lattice().cellVolumeMm3());
    return all > 0.0 ? std::sqrt(std::max(0.0, 1.0 - kept / all)) : 0.0;
}

} // namespace

FittingPlan planWithin(const scene::Scene &scene, const ShadedFields &shaded,
                       std::span<const plan::FieldSummary> summaries, const plan::Budget &budget,
                       const task::Progress &progress) {
    scene::validate(scene);
    const std::vector<classify::DensityField> &fields = shaded.fields;
    const plan::Composition composition = compositionOf(fields.size(), scene.shading);
    // If the image itself is too large for the memory, a coarser field does not help.
    const plan::SliceGrid least =
        plan::sliceGrid(scene.camera, {{summaries.front().energy.spread}, 1.0},
                        summaries.front().lattice, scene.image);
    const std::size_t frame = plan::frameBytes(least, scene.camera, composition.images);
    if (frame > budget.bytes)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::imageNeedsMemory(scene.camera.width, scene.camera.height,
                                                          (frame >> 20) + 1, budget.bytes >> 20));
    try {
        FittingPlan fitting{plan::planRender(scene, summaries, composition, budget), {}, 1};
        plan::adaptWidths(fitting.plan, scene, summaries);
        return fitting;
    } catch (const task::Error &error) {
        if (error.code() != task::ErrorCode::outOfMemory)
            throw;
        const volume::GridSize n = fields.front().values.lattice().size();
        const int longest = std::max({n.i, n.j, n.k});
        for (int reduction = 2; longest / reduction >= minSamples; ++reduction) {
            std::vector<classify::DensityField> reduced;
            std::size_t held = 0; // the samples need memory too
            double lost = 0.0;
            for (const classify::DensityField &field : fields) {
                progress.check();
                reduced.push_back(
                    classify::coarseField(field, (longest + reduction - 1) / reduction));
                lost = std::max(lost, lostDetail(field, reduced.back()));
            }
            // The gradient is that of the means, so that no sample becomes darker than black.
            ShadedFields coarse =
                shadedFields({std::move(reduced), shaded.colors}, scene.shading, shaded.scale);
            for (const auto *const samples : {&coarse.fields, &coarse.gradients})
                for (const classify::DensityField &field : *samples)
                    held += field.values.samples().bytes();
            // A gradient over a longer step has less energy; a low pass leaves out no more than
            // that.
            for (std::size_t g = 0; g < coarse.gradients.size(); ++g)
                lost = std::max(lost, lostDetail(shaded.gradients[g], coarse.gradients[g]));
            if (held >= budget.bytes)
                continue;
            try {
                scene::Scene uniform = scene; // its error is that of the lost detail
                uniform.interpolation.isUniform = true;
                FittingPlan fitting{plan::planRender(uniform, summarise(coarse, scene.shading.cue),
                                                     composition, {budget.bytes - held}),
                                    std::move(coarse), reduction};
                plan::RenderPlan &plan = fitting.plan;
                plan.predictedError =
                    std::hypot(plan.predictedError,
                               scene::detailGain(scene.image) * composition.errorFactor() * lost);
                plan.bytes += held;
                const volume::GridSize size =
                    fitting.reduced->fields.front().values.lattice().size();
                plan.reason = task::because::reduced(size.i, size.j, size.k, n.i, n.j, n.k);
                return fitting;
            } catch (const task::Error &smaller) {
                if (smaller.code() != task::ErrorCode::outOfMemory)
                    throw;
            }
        }
        throw;
    }
}

std::shared_ptr<const widths::AdaptiveWidths> adaptiveWidths(const render::EngineSpectra &spectra,
                                                             const plan::RenderPlan &plan,
                                                             const task::Progress &progress) {
    if (plan.adaptiveError == 0.0)
        return nullptr;
    const auto energiesOf = [&](const render::EngineSpectra::Spectra &of) {
        widths::AdaptiveWidths::Energies energies;
        for (const auto &spectrum : of)
            energies.push_back(std::make_shared<const widths::BlockEnergies>(*spectrum, progress));
        return energies;
    };
    return std::make_shared<const widths::AdaptiveWidths>(widths::AdaptiveWidths{
        std::make_shared<const fourier::KernelsByWidth>(plan.spectrum), energiesOf(spectra.fields),
        energiesOf(spectra.gradients), plan.adaptiveTolerance});
}

std::shared_ptr<render::CpuEngine> makeEngine(ShadedFields channels, const plan::RenderPlan &plan,
                                              const task::Progress &progress) {
    render::EngineSpectra spectra{{}, {}, channels.scale};
    const double count = double(channels.fields.size() + channels.gradients.size());
    double done = 0.0;
    const auto prepare = [&](classify::DensityField &field) {
        const task::Progress part = progress.part(done / count, (done + 1.0) / count);
        done += 1.0;
        return std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(std::exchange(field.values, {}), plan.spectrum, part));
    };
    for (classify::DensityField &field : channels.fields)
        spectra.fields.push_back(prepare(field));
    for (classify::DensityField &gradient : channels.gradients)
        spectra.gradients.push_back(prepare(gradient));
    auto widths = adaptiveWidths(spectra, plan, progress);
    auto engine = std::make_shared<render::CpuEngine>(std::move(spectra), plan.fieldOfView);
    engine->setWidths(std::move(widths));
    std::vector<render::ChannelWeights> weights;
    for (std::size_t n = 0; n < channels.fields.size(); ++n) {
        const classify::Color &color = channels.colors[n];
        weights.push_back({color.red, color.green, color.blue});
    }
    engine->setChannelWeights(std::move(weights));
    return engine;
}

PreparedEngine prepareEngine(const scene::Scene &scene, ShadedFields fields,
                             const plan::Budget &budget, const task::Progress &progress) {
    const auto summaries = summarise(fields, scene.shading.cue);
    FittingPlan fitting = planWithin(scene, fields, summaries, budget, progress);
    const plan::SpectrumOf of =
        fields.fields.size() > 1 ? plan::SpectrumOf::color : plan::SpectrumOf::look;
    if (fitting.reduced)
        fields = std::move(*fitting.reduced);
    auto engine = makeEngine(std::move(fields), fitting.plan, progress);
    const std::size_t bytes = engine->bytes();
    const bool canBeLit = engine->canBeLit();
    return {std::move(engine),
            std::move(fitting.plan),
            bytes,
            canBeLit,
            false,
            of,
            fitting.reduction,
            {}};
}

PreparedEngine prepareEngine(const scene::Scene &scene, classify::ShownFields fields,
                             const plan::Budget &budget, const task::Progress &progress,
                             const std::optional<shading::ShadingScale> &scale) {
    const volume::Lattice lattice = fields.channels.front().values.lattice();
    const std::size_t light = bytesForLight(scene.shading, lattice.size(), fields.channels.size());
    ShadedFields shaded =
        shadedFields(std::move(fields), scene.shading,
                     scale.value_or(shading::shadingScale(lattice)), progress.part(0.0, 0.1));
    return prepareEngine(scene, std::move(shaded),
                         {budget.bytes > light ? budget.bytes - light : 0},
                         progress.part(0.1, 1.0));
}

std::optional<error::StatedError> boundOf(const PreparedEngine &prepared,
                                          const scene::ImageDefinition &image) {
    if (prepared.isCoarse || prepared.of == plan::SpectrumOf::layer)
        return std::nullopt;
    const double bound = prepared.plan.predictedError * scene::detailGain(image) /
                         scene::detailGain(prepared.plan.image);
    return error::StatedError::atMost(bound);
}

PreparedEngine withoutLight(const PreparedEngine &prepared) {
    render::EngineParts parts = prepared.engine->parts();
    parts.spectra.gradients.clear();
    auto engine = std::make_shared<render::CpuEngine>(std::move(parts.spectra), parts.fieldOfView);
    engine->setWidths(std::move(parts.adaptive));
    engine->setChannelWeights(std::move(parts.channelWeights));
    const std::size_t bytes = engine->bytes();
    plan::RenderPlan plan = prepared.plan;
    plan.bytes -= prepared.bytes - bytes;
    return {std::move(engine), std::move(plan),    bytes,         false, prepared.isCoarse,
            prepared.of,       prepared.reduction, prepared.study};
}

} // namespace pellucid::prepare
