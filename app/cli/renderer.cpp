// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/renderer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/plan_json.h"
#include "core/error/shown_part.h"
#include "core/plan/folded_tails.h"
#include "core/reference/exact_engine.h"
#include "core/scene/planning_scene.h"
#include "core/task/error.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::cli {

using nlohmann::json;

namespace {

constexpr const char *whyExact = "no engine meets the tolerance: the exact reference does";

// The error for a user who requires the card: the card is too small, or we cannot use one.
task::Error cardRefused(const task::Error &error) {
    const bool isTooSmall = error.code() == task::ErrorCode::outOfMemory;
    return {isTooSmall ? error.code() : task::ErrorCode::noSuchDevice,
            task::because::inWords("--engine gpu: " + error.reason().english())};
}

// The error of the exact reference: rounding (about 1e-10 in double precision, or that of a shaded
// field's float samples) and the tails of the roll-off that fold back from its period.
double exactError(const scene::Scene &scene, const std::vector<plan::FieldSummary> &summaries,
                  const plan::Composition &composition) {
    const double rounding = scene.shading.isPlain() ? 1e-10 : 6e-8;
    double worst = 0.0;
    for (const plan::FieldSummary &summary : summaries) {
        const reference::Period period =
            reference::periodOf(summary.lattice, scene.camera, scene.image);
        const double tails = plan::predictFoldedTails(scene.image, scene.camera, period.columns,
                                                      period.rows, *summary.energy.spread);
        worst = std::max(worst, std::hypot(rounding, tails));
    }
    return composition.errorFactor() * worst;
}

void requireWithin(std::size_t needed, std::size_t limit) {
    if (needed > limit)
        throw task::Error(
            task::ErrorCode::outOfMemory,
            task::because::inWords(fmt::format("the pictures need {} MB, but only {} MB are left",
                                               (needed >> 20) + 1, limit >> 20)));
}

} // namespace

CardChoice chooseCard(const std::string &engine, int frames) {
    CardChoice choice{engine == "gpu", nullptr, "the graphics card was requested"};
    if (engine == "cpu")
        choice.reason = "the processor was requested";
    else if (engine == "auto" && frames < 2)
        choice.reason = "a single image is finished before its spectra would be on a graphics card";
    else
        try {
            choice.passes = std::make_shared<gpu::FramePasses>(std::make_shared<gpu::Device>(
                std::make_unique<gpu::SurfacelessContext>(choice.isRequired)));
            if (!choice.isRequired)
                choice.reason = "a graphics card was found";
            if (!choice.isRequired && choice.passes->device().capabilities().software) {
                choice.reason = "OpenGL runs on a software renderer";
                choice.passes.reset();
            }
        } catch (const task::Error &error) {
            if (choice.isRequired)
                throw cardRefused(error);
            choice.reason = error.reason().english();
        }
    return choice;
}

Renderer::Renderer(const scene::Scene &scene, classify::ShownFields &&fields,
                   const plan::Budget &budget, const Context &context, std::size_t limit)
    : Renderer(scene, sourcesOf(scene, std::move(fields), task::Progress(context.stop)), budget,
               context, limit) {}

Renderer::Renderer(const scene::Scene &scene, Sources sources, const plan::Budget &budget,
                   const Context &context, std::size_t limit)
    : m_scene(scene), m_progress(context.stop),
      m_images(std::size_t(
          prepare::compositionOf(sources.fields.channels.size(), scene.shading).images)),
      m_limit(limit),
      m_fitting(prepare::planWithin(
          scene::planningScene(scene, sources.shaded.fields.front().values.lattice()),
          sources.shaded, sources.summaries, budget, m_progress)),
      m_lattice(sources.shaded.fields.front().values.lattice()),
      m_box(sources.summaries.front().support) {
    const std::size_t exactBytes =
        reference::ExactEngine::bytes(m_lattice, sources.summaries.front().support, m_images,
                                      scene.camera, scene.image, scene.shading);
    const bool isMet = m_fitting.plan.predictedError <= scene.tolerance;
    const bool mustPlan = !scene.interpolation.isPlanned() ||
                          scene.plannedFor == scene::PlannedFor::volume || m_fitting.reduction > 1;
    const bool isPlanned = isMet || mustPlan || exactBytes > budget.bytes;
    requireWithin(isPlanned ? m_fitting.plan.bytes : exactBytes, limit);
    if (isPlanned)
        preparePlanned(std::move(sources));
    else
        prepareExact(std::move(sources), exactBytes);
}

void Renderer::requireRoomFor(const scene::Camera &camera) const {
    if (isExact())
        return; // it needs the same for every camera of this size
    const auto framesOf = [&](const scene::Camera &one) {
        return plan::frameBytes(
            plan::sliceGrid(one, m_fitting.plan.fieldOfView, m_lattice, m_scene.image), one,
            int(m_images));
    };
    requireWithin(m_bytes - std::min(m_bytes, framesOf(m_scene.camera)) + framesOf(camera),
                  m_limit);
}

Renderer::Sources Renderer::sourcesOf(const scene::Scene &scene, classify::ShownFields fields,
                                      const task::Progress &progress) {
    auto shaded = prepare::shadedFields(
        fields, scene.shading, shading::shadingScale(fields.channels.front().values.lattice()),
        progress);
    auto summaries = prepare::summarise(shaded, scene.shading.cue);
    return {std::move(fields), std::move(shaded), std::move(summaries)};
}

void Renderer::preparePlanned(Sources sources) {
    sources.fields = {};
    const plan::RenderPlan &plan = m_fitting.plan;
    if (m_fitting.reduced) {
        sources.shaded = std::move(*m_fitting.reduced);
        m_fitting.reduced.reset();
    }
    m_lattice = sources.shaded.fields.front().values.lattice();
    m_planned = prepare::makeEngine(std::move(sources.shaded), plan, m_progress);
    m_engine = m_planned;
    m_box = plan.spectrum.box;
    m_bytes = plan.bytes;
    m_predictedError = plan.predictedError;
}

void Renderer::prepareExact(Sources sources, std::size_t bytes) {
    const plan::Composition composition =
        prepare::compositionOf(sources.fields.channels.size(), m_scene.shading);
    m_engine = std::make_shared<reference::ExactEngine>(std::move(sources.fields), m_scene.shading,
                                                        m_progress);
    m_bytes = bytes;
    m_predictedError = exactError(m_scene, sources.summaries, composition);
}

void Renderer::use(const CardChoice &card) {
    m_choice = card;
    if (isExact()) {
        m_choice.reason = whyExact;
        if (card.isRequired)
            throw cardRefused({task::ErrorCode::noSuchDevice,
                               task::because::inWords(m_choice.reason + ", on the processor")});
        return;
    }
    if (!card.passes)
        return;
    try {
        m_card = gpu::copyToCard(card.passes, *m_planned, m_progress);
    } catch (const task::Error &error) {
        if (card.isRequired)
            throw cardRefused(error);
        m_choice.reason = error.reason().english();
    }
}

picture::ProjectionImage Renderer::image(const scene::Camera &camera, picture::FrameTimes &times) {
    std::optional<picture::ProjectionImage> image = imageOfCard(camera, times);
    if (!image)
        image = m_engine->render(camera, m_scene.image, m_scene.shading, &times);
    m_lastError = error::StatedError::atMost(m_predictedError);
    m_wasWhole = error::showsAllOf(m_box, m_lattice, camera);
    return std::move(*image);
}

std::optional<picture::ProjectionImage> Renderer::imageOfCard(const scene::Camera &camera,
                                                              picture::FrameTimes &times) {
    if (!m_card)
        return std::nullopt;
    try {
        return m_card->render(camera, m_scene.image, m_scene.shading, &times);
    } catch (const task::Error &error) {
        // The card was lost, or is too small for this image: the processor takes over, unless the
        // user requires the card.
        if (m_choice.isRequired)
            throw cardRefused(error);
        m_choice.reason = error.reason().english();
        m_card.reset();
        return std::nullopt;
    }
}

void Renderer::measure(const scene::Camera &camera, const classify::ShownFields &study) {
    if (isExact())
        return;
    render::ProjectionEngine &maker = m_card ? *m_card : *m_planned;
    m_lastError = prepare::measuredError(maker, study, camera, m_scene.image, m_scene.shading, {},
                                         m_progress);
}

std::string Renderer::description() const {
    const picture::Projector &maker = m_card ? *m_card : *m_engine;
    return maker.description().english();
}

json Renderer::planJson(const picture::FrameTimes &last) const {
    if (isExact())
        return exactPlanJson(m_images, m_bytes, m_predictedError, whyExact);
    const render::EngineParts parts = m_planned->parts();
    const auto fields = int(parts.spectra.fields.size());
    return cli::planJson(m_fitting.plan, m_scene,
                         {fields, fields > 1 ? plan::SpectrumOf::color : plan::SpectrumOf::look,
                          render::colorsOf(parts.channelWeights)},
                         m_lattice, last.widthShares);
}

} // namespace pellucid::cli
