// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/look_preparer.h"

#include <algorithm>
#include <utility>

#include "core/classify/layers.h"
#include "core/preprocess/step_cache.h"
#include "core/system/memory.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/engine/make_engines.h"

namespace pellucid::ui {

namespace {

using prepare::Detail;
using prepare::Occasion;
using prepare::Step;

// A pause that ends a drag.
constexpr int restMs = 300;
// Results of steps may occupy this part of the available memory.
constexpr std::size_t stepsShare = 4, maxStepsBytes = std::size_t(2) << 30;

} // namespace

PreparedFor wantedOf(const Document &document) {
    PreparedFor wanted(document.scene());
    // A scene that names the volume's own window asks for the same as one without a window.
    if (document.fieldWindow() == document.defaultFieldWindow())
        wanted.window.reset();
    return wanted;
}

LookPreparer::LookPreparer(Document &document, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs),
      m_steps(std::make_shared<preprocess::StepCache>(
          std::min(maxStepsBytes, system::availableMemoryBytes() / stepsShare))) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] { act(Occasion::handRested); });
    document.whenever(Change::scene, this, [this](Changes changes) {
        if (!(changes & Change::volume)) // what opens a volume says what it expects
            act(Occasion::sceneChanged);
    });
    // Queued: the code that ended the job may start the next one.
    connect(
        &jobs, &JobRunner::finished, this,
        [this] {
            if (m_jobs.isRunning() || !std::exchange(m_have.isHeld, false))
                return;
            prepareAgain();
        },
        Qt::QueuedConnection);
}

LookPreparer::~LookPreparer() = default;

void LookPreparer::awaitJob() {
    m_have.isHeld = m_jobs.isRunning(); // it is not if no thread could be had
}

void LookPreparer::prepareAgain() {
    m_have.givenUp.reset();
    m_have.layersGivenUp.reset();
    act(Occasion::sceneChanged);
}

PreparedFor LookPreparer::forgetVolume() {
    m_rest.stop();
    if (m_have.underway)
        take(Step::stopJob, {});
    m_have = {};
    m_layers.reset();
    m_full.reset();
    PreparedFor wanted = wantedOf(m_document);
    wanted.window.reset(); // a new volume has its own
    wanted.look = {};
    wanted.crop = {};
    wanted.image = {};
    wanted.cue = {};
    wanted.isLit = false;
    return wanted;
}

void LookPreparer::adopt(const PreparedFor &preparedFor, const prepare::PreparedEngine &engine) {
    m_full = engine;
    m_have.full = preparedFor;
    emit planChanged(PlanState::holds);
    take(Step::showFull, preparedFor);
}

void LookPreparer::cancel() {
    const bool isPreparing = m_have.underway.has_value();
    m_jobs.cancel();
    if (isPreparing)
        returnToShown();
}

void LookPreparer::returnToShown() {
    if (!m_have.full || !m_have.givenUp || wantedOf(m_document) == *m_have.full)
        return;
    const auto returned = [shown = *m_have.full, shading = m_fullShading](scene::Scene &scene) {
        scene.shading = shading;
        scene.fieldWindow = shown.window;
        scene.look = shown.look;
        scene.crop = shown.crop;
        scene.image = shown.image;
        scene.interpolation = shown.interpolation;
        scene.tolerance = shown.tolerance;
    };
    scene::Scene scene = m_document.scene();
    returned(scene);
    if (PreparedFor(scene) == *m_have.full)
        editScene(m_document, tr("Cancel"), noDrag, returned);
}

bool LookPreparer::canProject() const {
    const auto &volume = m_document.volume();
    return volume && !m_document.isPreview() && volume->notes().placed;
}

void LookPreparer::act(Occasion occasion) {
    if (!canProject())
        return;
    for (bool isDecided = false; !isDecided;) {
        const PreparedFor wanted = wantedOf(m_document);
        if (m_have.full && wanted == *m_have.full)
            m_fullShading = m_document.scene().shading;
        const Step step = prepare::next({wanted, occasion}, m_have);
        take(step, wanted);
        if (step == Step::awaitRest || step == Step::startLayers ||
            (step == Step::showLayers && occasion == Occasion::sceneChanged))
            m_rest.start();
        isDecided = !prepare::isFollowed(step);
    }
}

void LookPreparer::take(Step step, const PreparedFor &look) {
    if (prepare::startsJob(step)) {
        start(step, look);
        return;
    }
    m_have = prepare::afterStep(step, look, m_have);
    switch (step) {
    case Step::hold:
        m_rest.stop();
        emit planChanged(PlanState::holds);
        break;
    case Step::awaitScan:
        emit planChanged(PlanState::underway);
        break;
    case Step::stopJob:
        m_jobs.cancel();
        break;
    case Step::dropLight:
        m_full = prepare::withoutLight(*m_full);
        emit planChanged(PlanState::holds);
        showFull();
        break;
    case Step::showFull:
        showFull();
        break;
    case Step::showLayers:
        showLayers();
        break;
    case Step::nothing:
    case Step::awaitRest:
    case Step::startLayers: // these start jobs, above
    case Step::startFull:
    case Step::startCoarseFirst:
        break;
    }
}

void LookPreparer::showFull() {
    emit engineReady(*m_full, *m_have.shown);
}

void LookPreparer::showLayers() {
    // Layers of the coarse volume, or of fewer samples, lack detail.
    const PreparedFor shown = wantedOf(m_document);
    emit engineReady(
        {.engine = std::make_shared<prepare::MixtureEngine>(
             m_layers,
             classify::mixtureOf(shown.look, m_have.layers->adjustedClass).channelWeights),
         .plan = m_layers->plan(),
         .bytes = m_layers->bytes(),
         .isCoarse = m_layersAreCoarse || m_layers->reduction() > 1,
         .of = plan::SpectrumOf::layer,
         .study = studyFields({*m_document.volume(), shown, m_steps, m_document.segments()})},
        EngineStage::live);
}

void LookPreparer::start(Step step, const PreparedFor &wanted) {
    if (step == Step::startLayers) {
        PreparedFor layers = wanted;
        layers.adjustedClass = classify::onlyDifference(m_have.full->look, wanted.look);
        start(step, layers, tr("Preparing the parts of the look"), layersWork(layers));
        return;
    }
    m_rest.stop();
    emit planChanged(PlanState::underway);
    start(step, wanted, tr("Preparing the projection"),
          [volume = *m_document.volume(),
           prepare =
               preparation(wanted, 0.0, step == Step::startFull ? Detail::full : Detail::coarse)](
              const Job &job) { prepare(job, volume); });
}

void LookPreparer::start(Step step, const PreparedFor &wanted, const QString &title,
                         JobRunner::Work work) {
    const QString place = m_document.place();
    // The running job has to end, and call its `onEnd`, before this one counts as underway.
    m_jobs.cancel();
    m_have = prepare::afterStep(step, wanted, m_have);
    if (!m_have.layers)
        m_layers.reset();
    m_jobs.start(
        title, std::move(work), [this](const Outcome &outcome) { jobEnded(outcome); }, place);
}

JobRunner::Work LookPreparer::layersWork(const PreparedFor &wanted) {
    return [this, source = EngineSource{*m_document.volume(), wanted, m_steps,
                                        m_document.segments()}](const Job &job) {
        const auto deliver = [&](const std::shared_ptr<prepare::LayerSet> &layers, Detail detail) {
            job.deliver(
                [this, of = source.wanted, layers, detail] { takeLayers(of, layers, detail); });
        };
        makeLayers(source, deliver, job.progress());
    };
}

void LookPreparer::expect(const PreparedFor &wanted) {
    m_have.underway = {prepare::Underway::Makes::engine, wanted};
    m_have.givenUp.reset();
}

// A job that delivered everything, or that stopJob stopped, does not count as underway any more.
void LookPreparer::jobEnded(const Outcome &outcome) {
    if (!m_have.underway)
        return;
    const bool madeEngine = m_have.underway->makes == prepare::Underway::Makes::engine;
    m_have = prepare::afterGivingUp(m_have);
    if (!madeEngine)
        return;
    act(Occasion::gaveUp);
    emit planChanged(outcome.kind == Outcome::Kind::failed ? PlanState::failed
                                                           : PlanState::cancelled);
}

LookPreparer::Preparation LookPreparer::preparation(const PreparedFor &wanted, double from,
                                                    Detail first) {
    return [this, steps = m_steps, segments = m_document.segments(), wanted, from,
            first](const Job &job, const volume::Volume &volume) {
        const auto deliver = [&](const prepare::PreparedEngine &engine, Detail detail) {
            job.deliver([this, wanted, engine, detail] { takeEngine(wanted, engine, detail); });
        };
        makeEngine({volume, wanted, steps, segments}, first, deliver,
                   job.progress().part(from, 1.0));
    };
}

LookPreparer::PartialPreparation LookPreparer::partialPreparation(const PreparedFor &wanted) {
    return [this, steps = m_steps, wanted](const Job &job, const volume::Volume &volume, int side,
                                           const task::Progress &progress) {
        const auto deliver = [&](const prepare::PreparedEngine &engine, Detail detail) {
            job.deliver([this, wanted, engine, detail] { takeEngine(wanted, engine, detail); });
        };
        makeCoarseEngine({volume, wanted, steps, nullptr}, side, deliver, progress);
    };
}

void LookPreparer::takeEngine(const PreparedFor &of, const prepare::PreparedEngine &engine,
                              Detail detail) {
    if (detail == Detail::coarse) {
        m_have = prepare::afterCoarse(of, m_have);
        emit engineReady(engine, *m_have.shown);
        act(Occasion::sceneChanged); // it may have changed meanwhile
        return;
    }
    m_full = engine;
    m_have = prepare::afterFull(of, m_have);
    if (!m_have.layers)
        m_layers.reset();
    emit planChanged(PlanState::holds);
    showFull();
    act(Occasion::fullArrived);
}

void LookPreparer::takeLayers(const PreparedFor &of,
                              const std::shared_ptr<prepare::LayerSet> &layers, Detail detail) {
    m_have = prepare::afterLayers(of, detail, m_have);
    m_layers = layers;
    m_layersAreCoarse = detail == Detail::coarse;
    act(Occasion::layersArrived);
}

} // namespace pellucid::ui
