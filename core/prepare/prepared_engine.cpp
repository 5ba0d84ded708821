// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/prepare/prepared_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/classify/coarse_field.h"
#include "core/error/shown_part.h"
#include "core/plan/folded_tails.h"
#include "core/plan/reasons.h"
#include "core/plan/sum_plan.h"
#include "core/prepare/reasons.h"
#include "core/reference/exact_engine.h"
#include "core/scene/planning_scene.h"
#include "core/task/error.h"

namespace pellucid::prepare {

namespace {

std::size_t bytesOf(const ShadedFields &fields) {
    std::size_t bytes = 0;
    for (const auto *const samples : {&fields.fields, &fields.gradients})
        for (const classify::DensityField &field : *samples)
            bytes += field.values.samples().bytes();
    return bytes;
}

// If the image itself is too large for the memory, a coarser field does not help.
void requireImageFits(const scene::Scene &scene, const field::Summary &field, int images,
                      std::size_t bytes) {
    const plan::SliceGrid least =
        plan::sliceGrid(scene.camera, {{field.energy.spread}, 1.0}, field.lattice, scene.image);
    const std::size_t frame = plan::frameBytes(least, scene.camera, images);
    if (frame > bytes)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::imageNeedsMemory(scene.camera.width, scene.camera.height,
                                                          (frame >> 20) + 1, bytes >> 20));
}

// The error of the exact reference: rounding (about 1e-10 in double precision, or that of a shaded
// field's float samples) and the tails of the roll-off that fold back from its period.
double exactError(const scene::Scene &scene, const std::vector<field::Summary> &summaries,
                  const plan::Composition &composition) {
    const double rounding = scene.shading.isPlain() ? 1e-10 : 6e-8;
    double worst = 0.0;
    for (const field::Summary &summary : summaries) {
        const reference::Period period =
            reference::periodOf(summary.lattice, scene.camera, scene.image);
        const double tails = plan::predictFoldedTails(scene.image, scene.camera, period.columns,
                                                      period.rows, *summary.energy.spread);
        worst = std::max(worst, std::hypot(rounding, tails));
    }
    return composition.errorFactor() * worst;
}

// The gradient is that of the means, so that no sample becomes darker than black.
ShadedFields reduced(const ShadedFields &fields, int reduction, const shading::Shading &shading) {
    classify::ShownFields means{{}, fields.colors};
    for (const classify::DensityField &field : fields.fields)
        means.channels.push_back(classify::coarseField(
            field, classify::coarseSide(field.values.lattice().size(), reduction)));
    return shadedFields(std::move(means), shading, fields.scale);
}

std::shared_ptr<render::CpuEngine> engineOf(render::EngineParts parts) {
    auto engine = std::make_shared<render::CpuEngine>(std::move(parts.spectra), parts.fieldOfView);
    engine->setWidths(std::move(parts.adaptive));
    engine->setChannelWeights(std::move(parts.channelWeights));
    return engine;
}

// An engine that holds the fields, if it is faster and good enough. `needed`: its bytes, also if
// they exceed the budget.
std::optional<PreparedEngine> sumEngine(const scene::Scene &scene, classify::ShownFields &fields,
                                        const plan::Composition &composition,
                                        const plan::Budget &budget, const task::Progress &progress,
                                        std::optional<std::size_t> &needed) {
    scene::validate(scene);
    const std::span<const classify::DensityField> channels = fields.channels;
    const volume::Lattice lattice = channels.front().values.lattice();
    if (!plan::sumsPay(scene, lattice, field::boxOf(channels), composition))
        return std::nullopt;
    auto plan = plan::planSums(scene, field::summarise(channels), composition);
    if (!plan)
        return std::nullopt;
    needed = plan->bytes;
    if (plan->bytes > budget.bytes && budget.decides)
        return std::nullopt;
    requireWithin(plan->bytes, budget);
    PreparedEngine prepared{.plan = std::move(*plan),
                            .lattice = lattice,
                            .of = channels.size() > 1 ? plan::SpectrumOf::color
                                                      : plan::SpectrumOf::look};
    prepared.sums = std::make_shared<render::SumEngine>(std::move(fields), prepared.plan, progress);
    return prepared;
}

} // namespace

void requireWithin(std::size_t needed, const plan::Budget &budget) {
    if (needed > budget.bytes)
        throw task::Error(
            task::ErrorCode::outOfMemory,
            task::because::projectionNeedsMemory((needed >> 20) + 1, budget.bytes >> 20));
}

FittingPlan planWithin(const scene::Scene &scene, ShadedFields fields,
                       const plan::Composition &composition, const plan::Budget &budget,
                       const task::Progress &progress) {
    scene::validate(scene);
    const volume::GridSize n = fields.fields.front().values.lattice().size();
    const std::size_t bytes = budget.decides ? budget.bytes : plan::Budget{}.bytes;
    std::optional<task::Error> first; // of the fields as they are
    for (int reduction = 1;; ++reduction) {
        progress.check();
        ShadedFields fitting = reduction == 1 ? fields : reduced(fields, reduction, scene.shading);
        // The means need memory too, beside the samples.
        const std::size_t held = reduction == 1 ? 0 : bytesOf(fitting);
        const bool isLast = !budget.decides || classify::coarseSide(n, reduction + 1) == 0;
        if (held >= bytes && !isLast)
            continue;
        auto summaries = summarise(fitting, scene.shading.cue);
        requireImageFits(scene, summaries.front(), composition.images, bytes);
        try {
            plan::RenderPlan plan =
                plan::planRender(scene, summaries, composition, {bytes - std::min(bytes, held)});
            plan::adaptWidths(plan, scene, summaries);
            if (reduction > 1) {
                const volume::GridSize size = fitting.fields.front().values.lattice().size();
                plan.bytes += held;
                plan.reason = task::because::reduced(size.i, size.j, size.k, n.i, n.j, n.k);
            }
            return {std::move(plan), std::move(fitting), std::move(summaries), reduction};
        } catch (const task::Error &error) {
            if (error.code() != task::ErrorCode::outOfMemory)
                throw;
            if (!first)
                first = error;
            if (isLast)
                throw task::Error(*first);
        }
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

render::EngineSpectra spectraOf(ShadedFields fields, const plan::RenderPlan &plan,
                                const task::Progress &progress) {
    render::EngineSpectra spectra{{}, {}, fields.scale};
    const double count = double(fields.fields.size() + fields.gradients.size());
    double done = 0.0;
    const auto prepare = [&](classify::DensityField &field) {
        const task::Progress part = progress.part(done / count, (done + 1.0) / count);
        done += 1.0;
        return std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(std::exchange(field.values, {}), plan.spectrum, part));
    };
    for (classify::DensityField &field : fields.fields)
        spectra.fields.push_back(prepare(field));
    for (classify::DensityField &gradient : fields.gradients)
        spectra.gradients.push_back(prepare(gradient));
    return spectra;
}

std::shared_ptr<render::CpuEngine> makeEngine(ShadedFields channels, const plan::RenderPlan &plan,
                                              const task::Progress &progress) {
    std::vector<render::ChannelWeights> weights;
    for (std::size_t n = 0; n < channels.fields.size(); ++n) {
        const classify::Color &color = channels.colors[n];
        weights.push_back({color.red, color.green, color.blue});
    }
    render::EngineSpectra spectra = spectraOf(std::move(channels), plan, progress);
    auto widths = adaptiveWidths(spectra, plan, progress);
    return engineOf({std::move(spectra), std::move(weights), plan.fieldOfView, std::move(widths)});
}

PreparedEngine prepareEngine(EngineRequest request, const task::Progress &progress) {
    classify::ShownFields &fields = request.fields;
    const std::size_t channels = fields.channels.size();
    const volume::Lattice lattice = fields.channels.front().values.lattice();
    const scene::Scene scene = scene::planningScene(request.scene, lattice);
    plan::Composition composition = compositionOf(channels, scene.shading);
    if (scene.plannedFor == scene::PlannedFor::picture)
        composition.pictures = request.pictures;
    plan::Budget budget = request.budget;
    budget.bytes -= std::min(budget.bytes, bytesForLight(scene.shading, lattice.size(), channels));
    const bool mayBeExact = request.mayBeExact && scene.interpolation.isPlanned() &&
                            scene.plannedFor == scene::PlannedFor::picture;
    std::optional<std::size_t> sumBytes;
    if (request.mayBeSums)
        if (auto sums = sumEngine(scene, fields, composition, budget, progress, sumBytes))
            return std::move(*sums);
    classify::ShownFields exactFields = mayBeExact ? fields : classify::ShownFields{};
    ShadedFields shaded = shadedFields(std::move(fields), scene.shading,
                                       request.scale.value_or(shading::shadingScale(lattice)),
                                       progress.part(0.0, 0.1));
    FittingPlan fitting = [&] {
        try {
            return planWithin(scene, std::move(shaded), composition, budget,
                              progress.part(0.1, 1.0));
        } catch (const task::Error &error) {
            if (error.code() == task::ErrorCode::outOfMemory && sumBytes)
                requireWithin(*sumBytes, budget); // names the least that is enough
            throw;
        }
    }();
    PreparedEngine prepared{
        .plan = std::move(fitting.plan),
        .lattice = fitting.fields.fields.front().values.lattice(),
        .isCoarse = fitting.reduction > 1,
        .of = channels > 1 ? plan::SpectrumOf::color : plan::SpectrumOf::look,
    };
    if (mayBeExact && prepared.plan.predictedError > scene.tolerance && !prepared.isCoarse) {
        const std::size_t bytes = reference::ExactEngine::bytes(
            prepared.lattice, fitting.summaries.front().support, std::size_t(composition.images),
            scene.camera, scene.image, scene.shading);
        if (bytes <= budget.bytes || !budget.decides) {
            requireWithin(bytes, budget);
            prepared.plan.predictedError = exactError(scene, fitting.summaries, composition);
            prepared.plan.bytes = prepared.bytes = bytes;
            fitting.fields = {};
            prepared.exact = std::make_shared<reference::ExactEngine>(
                std::move(exactFields), scene.shading, progress.part(0.1, 1.0));
            return prepared;
        }
    }
    requireWithin(prepared.plan.bytes, budget);
    exactFields = {};
    auto engine = makeEngine(std::move(fitting.fields), prepared.plan, progress.part(0.1, 1.0));
    prepared.bytes = engine->bytes();
    prepared.canBeLit = engine->canBeLit();
    prepared.engine = std::move(engine);
    return prepared;
}

bool needsASpectrum(const PreparedEngine &prepared, const scene::Scene &scene) {
    if (!prepared.sums)
        return false;
    plan::Composition composition =
        compositionOf(prepared.sums->fields().channels.size(), scene.shading);
    composition.pictures = 1;
    return !plan::sumsPay(scene, prepared.lattice, prepared.plan.spectrum.box, composition);
}

std::optional<error::StatedError> boundOf(const PreparedEngine &prepared,
                                          const scene::ImageDefinition &image) {
    if (prepared.isCoarse || prepared.of == plan::SpectrumOf::layer)
        return std::nullopt;
    const double gain = scene::detailGain(image) / scene::detailGain(prepared.plan.image);
    return error::StatedError::atMost(prepared.plan.predictedError * gain);
}

bool missesTolerance(const PreparedEngine &prepared, const error::StatedError &measured,
                     error::Shown shown, const scene::Scene &scene) {
    const auto bound = boundOf(prepared, scene.image);
    return measured.isMeasured() && measured.judged(shown) > scene.tolerance && bound &&
           bound->relative <= scene.tolerance;
}

error::Shown shownOf(const PreparedEngine &prepared, const scene::Camera &camera) {
    return error::shownOf(prepared.plan.spectrum.box, prepared.lattice, camera);
}

PreparedEngine withOneWidth(const PreparedEngine &prepared) {
    PreparedEngine uniform = prepared;
    uniform.plan = plan::withOneWidth(prepared.plan);
    render::EngineParts parts = prepared.engine->parts();
    parts.adaptive.reset();
    uniform.engine = engineOf(std::move(parts));
    return uniform;
}

PreparedEngine withoutLight(const PreparedEngine &prepared) {
    render::EngineParts parts = prepared.engine->parts();
    parts.spectra.gradients.clear();
    auto engine = engineOf(std::move(parts));
    PreparedEngine unlit = prepared;
    unlit.bytes = engine->bytes();
    unlit.plan.bytes -= prepared.bytes - unlit.bytes;
    unlit.canBeLit = false;
    unlit.engine = std::move(engine);
    return unlit;
}

} // namespace pellucid::prepare
