// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scene_renderer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/cli/input.h"
#include "app/cli/scene_fields.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::cli {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

SceneRenderer::SceneRenderer(const scene::Scene &scene, Subject subject, const MemoryLimit &memory,
                             const CardChoice &card, const Context &context)
    : m_scene(scene), m_planned(scene), m_subject(std::move(subject)), m_card(card),
      m_context(context) {
    if (memory.isGiven)
        m_given = memory.bytes;
    makeFields(memory);
    prepare();
}

void SceneRenderer::makeFields(const MemoryLimit &memory) {
    Stopwatch watch;
    const volume::Volume &volume = m_subject.volume;
    m_window = windowFor(m_scene, volume);
    const std::size_t samples = volume.lattice().size().count();
    const std::size_t forLight = prepare::bytesForLight(m_scene.shading, volume.lattice().size(),
                                                        classify::channelsOf(m_scene.look));
    m_held = volume.bytes() + classify::peakBytes(m_scene.look, samples) + forLight;
    if (m_given && *m_given < m_held)
        throw Error(
            ErrorCode::outOfMemory,
            because::inWords(fmt::format("the volume needs {} MB, but only {} MB are allowed",
                                         (m_held >> 20) + 1, *m_given >> 20)),
            m_subject.path);
    m_fields = fieldsFor(m_scene, volume, m_subject.segments, m_context);
    m_whyEmpty = cli::whyEmpty(m_scene, volume, m_fields);
    if (!memory.decides) {
        m_budget.bytes = std::numeric_limits<std::size_t>::max();
        m_limit = std::size_t(*memory.bytes - std::min<std::uint64_t>(*memory.bytes, m_held));
        m_fieldMs = watch.lapMs();
        return;
    }
    // If the program asked for more than is available, the system would kill it.
    m_budget.bytes = system::availableMemoryBytes();
    m_budget.bytes -= std::min(m_budget.bytes, forLight); // not allocated yet
    if (memory.bytes)
        m_budget.bytes =
            std::min(m_budget.bytes,
                     std::size_t(*memory.bytes - std::min<std::uint64_t>(*memory.bytes, m_held)));
    m_fieldMs = watch.lapMs();
}

void SceneRenderer::prepare() {
    Stopwatch watch;
    try {
        m_renderer.reset();
        if (m_fields.channels.empty()) // this is not the first plan
            m_fields = fieldsFor(m_scene, m_subject.volume, m_subject.segments, m_context);
        // Another plan may need them, and steps of classes take long.
        classify::ShownFields fields = m_fields;
        if (!classify::haveRegions(m_scene.look.classes))
            m_fields = {};
        m_renderer.emplace(m_planned, std::move(fields), m_budget, m_context, m_limit);
        m_renderer->use(m_card);
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

// Whether the last picture misses the tolerance although the plan keeps it, and a closer plan may
// help.
bool SceneRenderer::mayPlanCloser() const {
    const error::StatedError &error = m_renderer->lastError();
    return error.isMeasured() && error.relative > m_scene.tolerance &&
           m_renderer->predictedError() <= m_scene.tolerance && !m_renderer->isReduced() &&
           m_scene.interpolation.isPlanned() && m_scene.plannedFor != scene::PlannedFor::volume;
}

classify::ShownFields SceneRenderer::studyFields() const {
    return m_fields.channels.empty()
               ? fieldsFor(m_scene, m_subject.volume, m_subject.segments, m_context)
               : m_fields;
}

// The plan is for the whole volume. The error of a part that contains little is known only after
// rendering it; if it misses the tolerance, plan again with a smaller one.
picture::ProjectionImage SceneRenderer::image(const scene::Camera &camera, Check check) {
    task::Progress(m_context.stop).check();
    const auto make = [&] {
        picture::ProjectionImage image = m_renderer->image(camera, m_times);
        if (check == Check::measure)
            m_renderer->measure(camera, studyFields());
        return image;
    };
    picture::ProjectionImage image = make();
    for (int tries = 0; tries < 3 && mayPlanCloser(); ++tries) {
        m_planned.tolerance *= 0.8 * m_scene.tolerance / m_renderer->lastError().relative;
        prepare();
        image = make();
    }
    takeErrors();
    return image;
}

const scene::Exposure &SceneRenderer::exposure() {
    if (!m_scene.tone.exposure)
        m_scene.tone.exposure = m_renderer->exposure(picture::backgroundOf(m_subject.volume));
    return *m_scene.tone.exposure;
}

std::vector<std::string> SceneRenderer::warnings() const {
    std::vector<std::string> warnings;
    if (m_renderer->isReduced())
        warnings.push_back(m_renderer->reason());
    if (!m_whyEmpty.empty())
        warnings.push_back(m_whyEmpty);
    // `reference` selects the exact method; its nominal tolerance is no target.
    if (m_renderer->predictedError() > m_scene.tolerance &&
        !(m_renderer->isExact() && m_scene.tolerance == scene::referenceTolerance))
        warnings.push_back(fmt::format("the tolerance of {:.2g} is not met: {:.2g} is predicted",
                                       m_scene.tolerance, m_renderer->predictedError()));
    return warnings;
}

std::string SceneRenderer::warningOfView() const {
    return missedText(m_renderer->lastError().relative, m_renderer->wasWhole());
}

std::string SceneRenderer::warningOfViews() const {
    return missedText(m_viewError, m_isWhole);
}

std::string SceneRenderer::missedText(double error, bool isWhole) const {
    const bool isMissed =
        error > m_scene.tolerance && m_renderer->predictedError() <= m_scene.tolerance;
    if (!isMissed)
        return {};
    return isWhole ? fmt::format("the tolerance of {:.2g} is not met: {:.2g} was measured for this "
                                 "picture",
                                 m_scene.tolerance, error)
                   : fmt::format("the tolerance of {:.2g} is met for the whole volume, but {:.2g} "
                                 "was measured for this part",
                                 m_scene.tolerance, error);
}

void SceneRenderer::takeErrors() {
    const error::StatedError &error = m_renderer->lastError();
    m_viewError = std::max(m_viewError, error.relative);
    if (error.isMeasured() && (!m_measured || error.relative > m_measured->relative))
        m_measured = error;
    m_isWhole = m_isWhole && m_renderer->wasWhole();
}

} // namespace pellucid::cli
