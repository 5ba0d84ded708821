// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/look_preparer.h"

#include <algorithm>
#include <utility>

#include "core/classify/coarse_field.h"
#include "core/classify/shown_fields.h"
#include "core/preprocess/step_cache.h"
#include "core/scene/planning_scene.h"
#include "core/system/memory.h"
#include "ui/document/document.h"
#include "ui/jobs/job_runner.h"

namespace pellucid::ui {

namespace {

// The coarse projection: small enough to be there within a blink of the volume.
constexpr int coarseSide = 96;
// A hand that pauses for longer rests.
constexpr int restMs = 300;
// What the results of steps may hold of the memory that is left.
constexpr std::size_t stepsShare = 4, mostStepsBytes = std::size_t(2) << 30;

bool isLarge(const volume::Volume &volume) {
    const volume::GridSize n = volume.lattice().size();
    return std::max({n.i, n.j, n.k}) > coarseSide;
}

// One engine serves every view of the pane.
scene::Scene planningScene(const volume::Volume &volume, const PreparedFor &wanted) {
    scene::Scene scene;
    scene.plannedFor = scene::PlannedFor::volume;
    scene.tolerance = wanted.tolerance;
    scene.interpolation = wanted.interpolation;
    scene.image = wanted.image;
    scene.shading.cue = wanted.cue;
    if (wanted.isLit)
        scene.shading.lights.emplace_back();
    return scene::planningScene(scene, volume.lattice());
}

accuracy::AxisProjections projectionsOf(const prepare::ShadedFields &shaded,
                                        const task::Progress &progress) {
    accuracy::AxisProjections projections;
    for (const auto *const fields : {&shaded.fields, &shaded.gradients})
        for (const classify::DensityField &field : *fields)
            projections.add(field, progress);
    return projections;
}

classify::FieldWindow windowOf(const volume::Volume &volume, const PreparedFor &wanted) {
    return wanted.window.value_or(classify::defaultFieldWindow(volume));
}

} // namespace

PreparedFor::PreparedFor(const scene::Scene &scene)
    : window(scene.fieldWindow), look(scene.look), crop(scene.crop), tolerance(scene.tolerance),
      interpolation(scene.interpolation), image(scene.image),
      cue(scene::plannedCue(scene.shading.cue)), isLit(scene.shading.isLit()) {}

PreparedFor::PreparedFor(const Document &document) : PreparedFor(document.scene()) {
    // The volume's own window is the same whether it is named or not.
    if (document.fieldWindow() == document.defaultFieldWindow())
        window.reset();
}

bool PreparedFor::hasLayersOf(const PreparedFor &other) const {
    return window == other.window && crop == other.crop && tolerance == other.tolerance &&
           interpolation == other.interpolation && image == other.image && cue == other.cue &&
           isLit == other.isLit &&
           classify::mixtureOf(look).layers == classify::mixtureOf(other.look).layers;
}

bool PreparedFor::showsSameAs(const PreparedFor &other) const {
    return window == other.window && look == other.look && crop == other.crop &&
           tolerance == other.tolerance && interpolation == other.interpolation;
}

LookPreparer::LookPreparer(Document &document, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs),
      m_steps(std::make_shared<preprocess::StepCache>(
          std::min(mostStepsBytes, system::availableMemoryBytes() / stepsShare))) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        // The layers first: they follow the hand.
        if (m_layersUnderway)
            m_rest.start();
        else
            settle();
    });
    connect(&document, &Document::sceneChanged, this, &LookPreparer::followScene);
    // Done or cancelled: what was not delivered is not there.
    connect(&jobs, &JobRunner::started, this, [this] { m_hasFailed = false; });
    connect(&jobs, &JobRunner::failed, this, [this] { m_hasFailed = true; });
    connect(&jobs, &JobRunner::finished, this, &LookPreparer::giveUp);
}

LookPreparer::~LookPreparer() = default;

void LookPreparer::giveUp() {
    if (m_underway) {
        m_givenUp = std::exchange(m_underway, std::nullopt);
        // Nothing follows the coarse picture: the former one is better than that.
        if (m_full && (m_shown == EngineStage::coarse || m_shown == EngineStage::live))
            showFull();
        emit planChanged(m_hasFailed ? PlanState::failed : PlanState::cancelled);
    }
    if (m_layersUnderway)
        m_layersGivenUp = std::exchange(m_layersUnderway, std::nullopt);
}

void LookPreparer::prepareAgain() {
    m_givenUp.reset();
    m_layersGivenUp.reset();
    followScene();
}

PreparedFor LookPreparer::forgetVolume() {
    m_rest.stop();
    m_prepared.reset();
    m_givenUp.reset();
    m_layers.reset();
    m_layersOf.reset();
    m_layersGivenUp.reset();
    m_full.reset();
    m_shown.reset();
    m_coarseToCome = false;
    PreparedFor wanted(m_document);
    wanted.window.reset(); // a new volume has its own
    wanted.look = {};
    wanted.crop = {};
    wanted.image = {};
    wanted.cue = {};
    wanted.isLit = false;
    return wanted;
}

void LookPreparer::adopt(const PreparedFor &preparedFor, const prepare::PreparedEngine &engine) {
    m_prepared = preparedFor;
    m_full = engine;
    emit planChanged(PlanState::holds);
    showFull();
}

void LookPreparer::announce() {
    emit planChanged(m_underway    ? PlanState::underway
                     : !m_givenUp  ? PlanState::holds
                     : m_hasFailed ? PlanState::failed
                                   : PlanState::cancelled);
    if (m_full)
        showFull();
}

void LookPreparer::showFull() {
    // After the layers the brightness is still theirs.
    const EngineStage stage =
        m_shown == EngineStage::live ? EngineStage::settled : EngineStage::full;
    m_shown = stage;
    emit engineReady(*m_full, stage);
}

void LookPreparer::stopOwnJob() {
    // Nobody gave up what the program itself stops.
    if (!m_underway && !m_layersUnderway)
        return;
    m_underway.reset();
    m_layersUnderway.reset();
    m_coarseToCome = false;
    m_jobs.cancel();
}

void LookPreparer::expect(const PreparedFor &wanted) {
    m_underway = wanted;
    m_givenUp.reset();
    if (!m_jobs.isRunning()) // there was no thread for it
        giveUp();
}

void LookPreparer::followScene() {
    const PreparedFor wanted(m_document);
    const auto &volume = m_document.volume();
    if (!volume || m_document.isPreview() || !volume->notes().placed || wanted == m_underway ||
        wanted == m_givenUp)
        return;
    if (m_held) {
        if (m_prepared && wanted != m_prepared)
            emit planChanged(PlanState::underway); // it comes when the scan is over
        return;
    }
    if (wanted == m_prepared) {
        // Back to what is there: nothing else is wanted any more, and may be wanted again.
        m_givenUp.reset();
        m_rest.stop();
        emit planChanged(PlanState::holds);
        if (m_underway)
            stopOwnJob();
        if (m_shown == EngineStage::live || m_shown == EngineStage::coarse)
            showFull();
        return;
    }
    // The first picture of the same with other weights is on its way, and the next will follow it:
    // a hand that moves would stop it again and again.
    if (m_underway && m_coarseToCome && wanted.hasLayersOf(*m_underway))
        return;
    if (m_prepared && wanted.showsSameAs(*m_prepared))
        followCueAndLight(wanted);
    else if (m_prepared && wanted.hasLayersOf(*m_prepared))
        followWeights(wanted);
    else
        startPreparing(true);
}

void LookPreparer::followCueAndLight(const PreparedFor &wanted) {
    if (m_prepared->isLit && !wanted.isLit) {
        // What the lights needed goes; what is left may be all that is wanted.
        PreparedFor unlit = *m_prepared;
        unlit.isLit = false;
        stopOwnJob();
        m_givenUp.reset();
        adopt(unlit, prepare::withoutLight(*m_full));
        if (wanted == unlit)
            return;
    }
    // A cue is seen at once with what there is; a light needs more, first of a small volume.
    const bool coarseFirst = wanted.isLit && !m_prepared->isLit;
    if (!coarseFirst && (m_shown == EngineStage::live || m_shown == EngineStage::coarse))
        showFull();
    startPreparing(coarseFirst);
}

void LookPreparer::settle() {
    const PreparedFor wanted(m_document);
    if (m_document.volume() && !m_document.isPreview() && !m_held && wanted != m_prepared &&
        wanted != m_underway && wanted != m_givenUp)
        startPreparing(false);
}

void LookPreparer::followWeights(const PreparedFor &wanted) {
    if (wanted.isLit) {
        // Under light the picture is no sum of layers: small pictures follow the hand.
        startPreparing(true);
        return;
    }
    // An engine of a former sum is no longer wanted, and takes the hand's time.
    if (m_underway)
        stopOwnJob();
    if (m_layers && m_layersOf->hasLayersOf(wanted))
        showLayers();
    else if (!(m_layersUnderway && m_layersUnderway->hasLayersOf(wanted)) &&
             !(m_layersGivenUp && m_layersGivenUp->hasLayersOf(wanted)))
        startLayers(wanted);
    m_rest.start();
}

void LookPreparer::showLayers() {
    m_shown = EngineStage::live;
    // What was made of a small volume, or of fewer samples, lacks detail.
    emit engineReady({std::make_shared<prepare::MixtureEngine>(
                          m_layers, classify::mixtureOf(m_document.scene().look).shares),
                      m_layers->plan(), m_layers->bytes(), false, m_layers->viewError(),
                      m_layersAreCoarse || m_layers->reduction() > 1,
                      m_layersAreCoarse ? nullptr : m_layers->detailLoss(),
                      plan::SpectrumOf::layer},
                     EngineStage::live);
}

void LookPreparer::startLayers(const PreparedFor &wanted) {
    stopOwnJob();
    m_layers.reset();
    m_layersOf.reset();
    m_jobs.start(
        tr("Preparing the parts of the look"),
        [this, volume = *m_document.volume(), wanted, steps = m_steps](const Job &job) {
            const auto mixture = classify::mixtureOf(wanted.look);
            const classify::FieldWindow window = windowOf(volume, wanted);
            const auto announce = [&](const volume::Volume &of, bool isLast,
                                      const task::Progress &progress) {
                const auto layers = prepare::LayerSet::prepare(
                    planningScene(of, wanted), mixture.layers.size(),
                    [&](std::size_t n, const task::Progress &p) {
                        return classify::cropped(
                            classify::layerField(of, window, mixture.layers[n], steps.get(), p),
                            wanted.crop);
                    },
                    // Half of it: engines of the sum are to come.
                    {system::availableMemoryBytes() / 2}, progress,
                    shading::shadingScale(volume.lattice()));
                job.deliver([this, layers, wanted, isLast] {
                    m_layers = layers;
                    m_layersOf = wanted;
                    m_layersAreCoarse = !isLast;
                    if (isLast)
                        m_layersUnderway.reset();
                    const PreparedFor now(m_document);
                    if (m_prepared && now != *m_prepared && now.hasLayersOf(wanted))
                        showLayers();
                });
            };
            // First of a small volume: the hand does not wait.
            if (isLarge(volume))
                announce(classify::coarseVolume(volume, coarseSide), false,
                         job.progress().part(0.0, 0.1));
            announce(volume, true, job.progress().part(0.1, 1.0));
        },
        m_document.place());
    m_layersUnderway = wanted;
    if (!m_jobs.isRunning())
        giveUp();
}

void LookPreparer::startPreparing(bool coarseFirst) {
    const PreparedFor wanted(m_document);
    m_rest.stop();
    stopOwnJob();
    emit planChanged(PlanState::underway);
    m_jobs.start(
        tr("Preparing the projection"),
        [volume = *m_document.volume(),
         prepare = preparation(wanted, 0.0, coarseFirst)](const Job &job) { prepare(job, volume); },
        m_document.place());
    // Now that the end of the former job has been told.
    expect(wanted);
    m_coarseToCome = coarseFirst;
}

LookPreparer::Preparation LookPreparer::preparation(const PreparedFor &wanted, double from,
                                                    bool coarseFirst) {
    return [this, steps = m_steps, wanted, from, coarseFirst](const Job &job,
                                                              const volume::Volume &volume) {
        const task::Progress progress = job.progress().part(from, 1.0);
        const scene::Scene scene = planningScene(volume, wanted);
        const std::size_t needed =
            classify::peakBytes(wanted.look, volume.lattice().size().count()) +
            prepare::bytesForLight(scene.shading, volume.lattice().size(),
                                   classify::mixesColors(wanted.look) ? 3 : 1);
        if (needed > system::availableMemoryBytes())
            throw task::Error(task::ErrorCode::outOfMemory,
                              task::because::fieldsNeedMemory(needed >> 20));
        const classify::FieldWindow window = windowOf(volume, wanted);
        const bool isShownTwice = coarseFirst && isLarge(volume);
        const shading::ShadingScale scale = shading::shadingScale(volume.lattice());
        const auto announce = [&](const prepare::PreparedEngine &prepared, bool isLast) {
            job.deliver([this, prepared, isLast, wanted] {
                m_coarseToCome = false;
                if (!isLast) {
                    // A coarse picture leaves the full one wanted. Of weights that move it keeps
                    // the brightness, as their layers do.
                    const bool isLive = m_prepared && wanted.hasLayersOf(*m_prepared);
                    m_shown = isLive ? EngineStage::live : EngineStage::coarse;
                    emit engineReady(prepared, *m_shown);
                    if (PreparedFor(m_document) != wanted)
                        followScene();
                    return;
                }
                m_underway.reset();
                m_givenUp.reset();
                // Layers of another look are of no more use.
                if (m_layersOf && !m_layersOf->hasLayersOf(wanted)) {
                    m_layers.reset();
                    m_layersOf.reset();
                    m_shown.reset();
                }
                adopt(wanted, prepared);
                // Of a small volume the first picture is the last. What was waited for meanwhile is
                // a look of its own, with its own brightness.
                if (m_document.volume() && !m_document.isPreview() && !m_held &&
                    PreparedFor(m_document) != wanted)
                    startPreparing(true);
            });
        };
        const auto fieldsOf = [&](const volume::Volume &of, const task::Progress &p) {
            return classify::cropped(classify::shownFields(of, window, wanted.look, steps.get(), p),
                                     wanted.crop);
        };
        const auto budget = [&](const classify::ShownFields &fields) {
            const std::size_t free = system::availableMemoryBytes(),
                              light = prepare::bytesForLight(
                                  scene.shading, fields.channels.front().values.lattice().size(),
                                  fields.channels.size());
            return plan::Budget{free > light ? free - light : 0};
        };
        // First of a small volume, on which steps take no time.
        std::optional<prepare::PreparedEngine> first;
        accuracy::AxisProjections coarse;
        if (isShownTwice) {
            const auto fields = fieldsOf(classify::coarseVolume(volume, coarseSide), {});
            const auto shaded = prepare::shadedFields(fields.channels, scene.shading, scale);
            first = prepare::prepareEngine(scene, shaded, fields.color, budget(fields),
                                           progress.part(0.0, 0.1));
            first->isCoarse = true;
            announce(*first, false);
            coarse = projectionsOf(shaded, progress);
        }
        const auto fields = fieldsOf(volume, progress.part(0.1, 0.3));
        const plan::Budget whole = budget(fields);
        const auto shaded =
            prepare::shadedFields(fields.channels, scene.shading, scale, progress.part(0.3, 0.35));
        if (first) {
            // The error of the small picture, while it is shown.
            first->detailLoss = std::make_shared<const accuracy::DetailLoss>(
                projectionsOf(shaded, progress), coarse, fields.channels.size(), scale.stepMm);
            announce(*first, false);
        }
        announce(
            prepare::prepareEngine(scene, shaded, fields.color, whole, progress.part(0.35, 1.0)),
            true);
    };
}

} // namespace pellucid::ui
