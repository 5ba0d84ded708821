// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_renderer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/input.h"
#include "app/cli/plan_json.h"
#include "app/cli/scene_fields.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::cli {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

namespace {

constexpr const char *whyExact =
    "no approximate engine meets the tolerance, so the exact reference is used";
constexpr const char *whyNotOnCard =
    "no approximate engine meets the tolerance, and the exact reference runs only on the processor";

} // namespace

SceneRenderer::SceneRenderer(const scene::Scene &scene, Subject subject, int pictures,
                             const MemoryLimit &memory, const CardChoice &card,
                             const Context &context)
    : m_scene(scene), m_planned(scene), m_subject(std::move(subject)), m_pictures(pictures),
      m_card(card), m_context(context), m_progress(context.stop) {
    if (memory.isGiven)
        m_given = memory.bytes;
    makeFields(memory);
    prepare();
}

void SceneRenderer::makeFields(const MemoryLimit &memory) {
    Stopwatch watch;
    const volume::Volume &volume = m_subject.volume;
    m_window = windowFor(m_scene, volume);
    m_held = volume.bytes() +
             prepare::bytesForFields(m_scene.look, m_scene.shading, volume.lattice().size());
    if (m_given && *m_given < m_held)
        throw Error(
            ErrorCode::outOfMemory,
            because::inWords(fmt::format("the volume needs {} MB, but only {} MB are allowed",
                                         (m_held >> 20) + 1, *m_given >> 20)),
            m_subject.path);
    m_fields = fieldsFor(m_scene, volume, m_subject.segments, m_context);
    m_whyEmpty = cli::whyEmpty(m_scene, volume, m_fields);
    m_budget.decides = memory.decides; // the engine subtracts what light needs
    // If the program asked for more than is available, the system would kill it.
    if (memory.decides)
        m_budget.bytes = system::availableMemoryBytes();
    if (memory.bytes)
        m_budget.bytes =
            std::min(m_budget.bytes,
                     std::size_t(*memory.bytes -
                                 std::min<std::uint64_t>(*memory.bytes, m_held - bytesForLight())));
    m_fieldMs = watch.lapMs();
}

void SceneRenderer::prepare() {
    Stopwatch watch;
    try {
        m_onCard.reset();
        m_prepared.reset();
        if (m_fields.channels.empty()) // this is not the first plan
            m_fields = fieldsFor(m_scene, m_subject.volume, m_subject.segments, m_context);
        // Another plan may need them, and steps of classes take long.
        classify::ShownFields fields = m_fields;
        if (!classify::haveRegions(m_scene.look.classes))
            m_fields = {};
        m_prepared = prepare::prepareEngine({.scene = m_planned,
                                             .fields = std::move(fields),
                                             .budget = m_budget,
                                             .mayBeExact = true,
                                             .mayBeSums = !m_card.passes,
                                             .pictures = m_pictures},
                                            m_progress);
        if (m_prepared->sums) // it holds them
            m_fields = m_prepared->sums->fields();
        useCard();
    } catch (const Error &error) {
        if (error.code() != ErrorCode::outOfMemory || !m_given)
            throw;
        throw Error(
            error.code(),
            because::inWords(fmt::format("{}; the volume and its fields take {} of {} MB",
                                         error.reason().english(), m_held >> 20, *m_given >> 20)),
            m_subject.path);
    }
    m_prepareMs += watch.lapMs();
}

void SceneRenderer::useCard() {
    m_engineReason = m_card.reason;
    if (isExact()) {
        m_engineReason = whyExact;
        if (m_card.isRequired)
            throw cardRefused({ErrorCode::noSuchDevice, because::inWords(whyNotOnCard)});
        return;
    }
    if (!m_card.passes)
        return;
    try {
        m_onCard = gpu::copyToCard(m_card.passes, *m_prepared->engine, m_progress);
    } catch (const Error &error) {
        if (m_card.isRequired)
            throw cardRefused(error);
        m_engineReason = error.reason().english();
    }
}

void SceneRenderer::requireRoomFor(const scene::Camera &camera) const {
    if (isExact() || m_budget.decides)
        return; // the exact reference needs the same for every camera of this size
    const auto framesOf = [&](const scene::Camera &one) {
        return plan::frameBytes(
            plan::sliceGrid(one, m_prepared->plan.fieldOfView, m_prepared->lattice, m_scene.image),
            one, images());
    };
    plan::Budget left = m_budget;
    left.bytes -= std::min(left.bytes, bytesForLight());
    prepare::requireWithin(bytes() - std::min(bytes(), framesOf(m_scene.camera)) + framesOf(camera),
                           left);
}

std::size_t SceneRenderer::bytesForLight() const {
    return prepare::bytesForLight(m_scene.shading, m_subject.volume.lattice().size(),
                                  classify::channelsOf(m_scene.look));
}

int SceneRenderer::images() const {
    return prepare::compositionOf(classify::channelsOf(m_scene.look), m_scene.shading).images;
}

std::optional<error::StatedError> SceneRenderer::bound() const {
    return prepare::boundOf(*m_prepared, m_scene.image);
}

bool SceneRenderer::boundMeetsTolerance() const {
    const auto known = bound();
    return known && known->relative <= m_scene.tolerance;
}

// Whether the last picture may miss the tolerance although the plan keeps it.
bool SceneRenderer::missesTolerance() const {
    return prepare::missesTolerance(*m_prepared, m_lastError, m_shown, m_scene);
}

bool SceneRenderer::mayPlanCloser() const {
    return missesTolerance() && !m_lastError.mayBeAll(m_shown) &&
           m_scene.interpolation.isPlanned() && m_scene.plannedFor != scene::PlannedFor::volume;
}

// Returns false if a closer plan does not fit into memory: the plan stays as it was.
bool SceneRenderer::planCloser() {
    const double before = m_planned.tolerance;
    m_planned.tolerance *= 0.8 * m_scene.tolerance / judgedError();
    try {
        prepare();
    } catch (const Error &error) {
        if (error.code() != ErrorCode::outOfMemory)
            throw;
        m_planned.tolerance = before;
        prepare();
        return false;
    }
    return true;
}

// The next picture chooses its widths again, as in the window.
picture::ProjectionImage SceneRenderer::imageOfOneWidth(const scene::Camera &camera, Check check) {
    return make(
        camera, check,
        {prepare::withOneWidth(*m_prepared), m_onCard ? m_onCard->withOneWidth() : nullptr});
}

const classify::ShownFields &SceneRenderer::studyFields() {
    if (m_fields.channels.empty())
        m_fields = fieldsFor(m_scene, m_subject.volume, m_subject.segments, m_context);
    return m_fields;
}

// The plan is for the whole volume. The error of a part that contains little is known only after
// rendering it; if it may miss the tolerance, plan again with a smaller one, while that helps, and
// finally render it with one kernel. The workstation's plan stays.
picture::ProjectionImage SceneRenderer::image(const scene::Camera &camera, Check check) {
    m_progress.check();
    // Fitted to the body, a picture may have far smaller pixels than the scene's camera.
    scene::Scene shown = m_planned;
    shown.camera = camera;
    if (prepare::needsASpectrum(*m_prepared, shown)) {
        m_planned = shown;
        prepare();
    }
    picture::ProjectionImage image = make(camera, check);
    for (int tries = 0; tries < 3 && mayPlanCloser(); ++tries) {
        const double before = judgedError();
        const bool isCloser = planCloser();
        image = make(camera, check);
        if (!isCloser || judgedError() >= before)
            break; // a closer plan no longer helps
    }
    if (missesTolerance() && prepare::choosesWidths(*m_prepared))
        image = imageOfOneWidth(camera, check);
    takeErrors();
    return image;
}

picture::ProjectionImage SceneRenderer::make(const scene::Camera &camera, Check check, Makers by) {
    std::optional<picture::ProjectionImage> image;
    if (by.onCard)
        image = imageOfCard(camera, *by.onCard);
    if (!image) {
        by.onCard.reset();
        image = by.prepared.projector().render(camera, m_scene.image, m_scene.shading, &m_times);
    }
    m_shown = prepare::shownOf(by.prepared, camera);
    const auto known = bound();
    if (known)
        m_lastError = *known;
    // Nothing could check the exact reference.
    if (!isExact() && (check == Check::measure || !known))
        measure(camera, by.onCard ? static_cast<picture::PeriodProjector &>(*by.onCard)
                                  : by.prepared.measurable());
    return std::move(*image);
}

std::optional<picture::ProjectionImage> SceneRenderer::imageOfCard(const scene::Camera &camera,
                                                                   gpu::GpuEngine &card) {
    try {
        return card.render(camera, m_scene.image, m_scene.shading, &m_times);
    } catch (const Error &error) {
        // The card was lost, or is too small for this image: the processor takes over, unless the
        // user requires the card.
        if (m_card.isRequired)
            throw cardRefused(error);
        m_engineReason = error.reason().english();
        m_onCard.reset();
        return std::nullopt;
    }
}

void SceneRenderer::measure(const scene::Camera &camera, picture::PeriodProjector &maker) {
    // The question is whether the picture keeps the tolerance, not by how much.
    m_lastError =
        prepare::measuredError(maker, studyFields(), camera, m_scene.image, m_scene.shading,
                               {.enough = m_scene.tolerance}, m_progress);
}

std::string SceneRenderer::description() const {
    const picture::Projector &maker = m_onCard ? *m_onCard : m_prepared->projector();
    return maker.description().english();
}

nlohmann::json SceneRenderer::planJson() const {
    const plan::RenderPlan &plan = m_prepared->plan;
    if (isExact())
        return exactPlanJson(images(), plan, whyExact);
    if (m_prepared->sums)
        return sumPlanJson(images(), plan);
    const render::EngineParts parts = m_prepared->engine->parts();
    nlohmann::json json = cli::planJson(
        plan, m_scene,
        {int(parts.spectra.fields.size()), m_prepared->of, render::colorsOf(parts.channelWeights)},
        m_prepared->lattice, m_times.widthShares);
    if (!bound()) // the plan is for reduced fields
        json["predicted_error"] = nullptr;
    return json;
}

const scene::Exposure &SceneRenderer::exposure() {
    if (!m_scene.tone.exposure)
        m_scene.tone.exposure = picture::measureExposure(
            m_prepared->projector(), m_prepared->lattice, m_scene.image, m_scene.shading,
            m_scene.tone, picture::backgroundOf(m_subject.volume));
    return *m_scene.tone.exposure;
}

std::vector<std::string> SceneRenderer::warnings() const {
    std::vector<std::string> warnings;
    if (m_prepared->isCoarse)
        warnings.push_back(m_prepared->plan.reason.english());
    if (!m_whyEmpty.empty())
        warnings.push_back(m_whyEmpty);
    // `reference` selects the exact method; its nominal tolerance is no target.
    if (const auto known = bound(); known && !boundMeetsTolerance() &&
                                    !(isExact() && m_scene.tolerance == scene::referenceTolerance))
        warnings.push_back(fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted",
                                       m_scene.tolerance, known->relative));
    return warnings;
}

std::string SceneRenderer::warningOfView() const {
    return missedText(judgedError(), m_shown);
}

std::string SceneRenderer::warningOfViews() const {
    return missedText(m_viewError, m_allShown);
}

std::string SceneRenderer::missedText(double error, error::Shown shown) const {
    const bool isMissed =
        error > m_scene.tolerance && (m_prepared->isCoarse || boundMeetsTolerance());
    if (!isMissed)
        return {};
    if (shown == error::Shown::whole || m_prepared->isCoarse)
        return fmt::format(
            "the tolerance of {:.2g} is not met: {:.2g} was measured for this picture",
            m_scene.tolerance, error);
    if (error >= 1.0) // all of it may be error
        return fmt::format("the tolerance of {:.2g} is met for the whole volume, but this part "
                           "contains so little that it may exceed the tolerance",
                           m_scene.tolerance);
    return fmt::format("the tolerance of {:.2g} is met for the whole volume, but the error of this "
                       "part may be up to {:.2g}",
                       m_scene.tolerance, error);
}

void SceneRenderer::takeErrors() {
    m_viewError = std::max(m_viewError, judgedError());
    if (m_lastError.isMeasured() && (!m_measured || m_lastError.relative > m_measured->relative))
        m_measured = m_lastError;
    if (m_shown == error::Shown::part)
        m_allShown = error::Shown::part;
}

} // namespace pellucid::cli
