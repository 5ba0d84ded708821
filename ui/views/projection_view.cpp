// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_view.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "core/task/error.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/views/camera_moves.h"
#include "ui/views/projection_overlay.h"
#include "ui/views/projection_texts.h"
#include "ui/views/tools/orbit_tool.h"
#include "ui/views/tools/tone_tool.h"

namespace pellucid::ui {

namespace {

// A full frame that takes longer lags behind the hand: drafts are drawn while the view moves.
constexpr double smoothFrameMs = 35.0;
// The first frame also allocates its memory and may take three times as long as the next.
constexpr double firstFrameFactor = 3.0;
constexpr int restMs = 120;
// A hand that rests for so long has come to look.
constexpr int checkMs = 300;
// With one kernel, or on the card, a frame costs as much as its pixels. Its pixels are then no
// smaller than a quarter of a voxel, or 1/4096 of the volume's diameter if that is less: smaller
// ones would show only the smoothness of the reconstruction.
constexpr double pixelsPerVoxel = 4.0, pixelsAcross = 4096.0;

} // namespace

ProjectionView::ProjectionView(Document &document, QWidget *parent)
    : VolumePane(document, PaneView::projection, parent), m_canvas(makeProjectionCanvas(this)),
      m_overlay(new ProjectionOverlay(document, m_tools, this)), m_comparison(document) {
    m_tools.addTurning(std::make_unique<OrbitTool>(*this, *this));
    m_tools.addRight(std::make_unique<ToneTool>(document, *this));
    m_tools.choose(Tool::window);
    setObjectName("projectionView");
    setAccessibleName(tr("Projection"));
    setMinimumSize(200, 160);
    m_document.setProjectionSize(sizeInPixels());
    m_canvas->widget()->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_overlay->raise();
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] { requestFrame(false); });
    m_check.setSingleShot(true);
    m_check.setInterval(checkMs);
    connect(&m_check, &QTimer::timeout, this, &ProjectionView::measureError);
    connect(&m_meter, &ErrorMeter::measured, this,
            [this](std::uint64_t number, const error::StatedError &error) {
                if (!m_frame || m_frame->number != number)
                    return;
                m_frameError = error;
                showTexts();
                emit errorMeasured(error);
            });
    connect(&m_worker, &RenderWorker::frameReady, this, &ProjectionView::takeFrame);
    connect(&m_worker, &RenderWorker::failed, this, [this](const task::Reason &reason) {
        m_pending = false;
        setMessage(translated(reason));
    });
    connect(&m_worker, &RenderWorker::cardFailed, this, &ProjectionView::cardFailed);
    connect(&document, &Document::changed, this, &ProjectionView::follow);
}

ProjectionView::~ProjectionView() {
    // The canvas is also a child widget: destroy it before the base class deletes the children.
    m_canvas.reset();
}

void ProjectionView::follow(Changes changes) {
    if (changes & (Change::pose | Change::paneSize))
        m_overlay->setMapping(mapping());
    if (changes & (Change::measurements | Change::selection) ||
        (m_orbitsCrosshair && (changes & Change::crosshair)))
        m_overlay->update();
    if (changes & Change::volume) {
        if (!m_document.volume() || !m_document.isPreview())
            forgetVolume();
        if (const auto exposure = m_document.exposure()) // of a study that comes back
            m_tone.adopt(*exposure, m_document.scene());
        updateTone();
        return;
    }
    // The points of a figure belong to one view.
    const glm::dquat seenFrom = m_document.scene().camera.orientation;
    if (std::exchange(m_seenFrom, seenFrom) != seenFrom && m_tools.isMeasuring())
        m_tools.cancel();
    if (changes & Change::scene)
        updateTone();
    if (changes & (Change::scene | Change::pose | Change::paneSize))
        requestFrame(bool(changes & Change::moving));
}

// Engine and picture belong to another volume.
void ProjectionView::forgetVolume() {
    m_prepared.reset();
    m_onCard.reset();
    m_worker.setEngine(std::nullopt, nullptr, ++m_generation);
    m_planState = PlanState::holds;
    m_tools.cancel();
    m_comparison.forget();
    setComparing(false);
    if (m_tone.outlivesVolume(m_document.volume().has_value()))
        return;
    m_frame.reset();
    m_fitsNext = true;
    m_body = {};
    m_drawnShading = {};
    m_message.clear();
    m_waiting = m_document.volume() ? Waiting::underway : Waiting::no;
    m_canvas->setImage(nullptr);
    showTexts();
}

void ProjectionView::setEngine(const ShownEngine &shown, EngineStage stage) {
    if (m_prepared && m_prepared->engine == shown.prepared.engine && m_onCard == shown.onCard &&
        m_stage == stage && m_engineReason == shown.reason) {
        // The same engine comes again: frames that are underway remain valid.
        m_prepared = shown.prepared;
        m_worker.setEngine(shown.prepared, shown.onCard, m_generation);
        requestFrame(m_rest.isActive());
        return;
    }
    m_prepared = shown.prepared;
    m_message.clear();
    m_waiting = Waiting::no;
    // Weights that move are meant to change the brightness. Other fields, and the full ones after
    // the coarse ones, have a brightness of their own.
    const bool sameFields = stage == EngineStage::live || stage == EngineStage::settled;
    if (!sameFields) {
        m_tone.beginFields(m_document.scene());
        m_fullFrameMs = 0.0;
        m_isFirstFrame = true;
    }
    // Frames of slightly older weights are shown, too: the hand may be faster than the frames.
    if (stage != EngineStage::live || m_stage != EngineStage::live)
        ++m_generation;
    m_stage = stage;
    m_worker.setEngine(shown.prepared, shown.onCard, m_generation);
    m_onCard = shown.onCard;
    m_engineReason = shown.reason;
    requestFrame(false);
}

void ProjectionView::jobEnded() {
    if (m_waiting == Waiting::underway)
        setWaiting(Waiting::cancelled);
}

void ProjectionView::jobStarted() {
    if (m_waiting == Waiting::cancelled)
        setWaiting(Waiting::underway);
}

void ProjectionView::adoptCamera(const scene::Camera &wanted,
                                 const std::optional<glm::dvec3> &pivotMm) {
    Pose pose = m_document.poseOf(wanted);
    pose.panMm = pannedTo(pose, pivotMm.value_or(this->pivotMm()), this->pivotMm());
    m_document.setPose(pose, true); // a linked view may be moving
}

void ProjectionView::setLookName(const QString &name) {
    m_lookName = name;
    showTexts();
}

void ProjectionView::holdExposure() {
    if (m_frame)
        m_tone.hold();
}

void ProjectionView::retakeExposure() {
    m_tone.retake();
    requestFrame(false);
}

void ProjectionView::setPlanState(PlanState state) {
    m_planState = state;
    if (m_frame && !m_frame->draft && !m_pending)
        m_check.start(); // a coarse picture may stay
    showTexts();
}

void ProjectionView::setMessage(const QString &message) {
    m_message = message;
    setWaiting(Waiting::no);
}

void ProjectionView::setWaiting(Waiting waiting) {
    m_waiting = waiting;
    showTexts();
}

void ProjectionView::resetView() {
    m_body = m_tone.exposure();
    m_document.setPose(fittedToBody({}));
    editScene(m_document, tr("Reset window"), noDrag, [](scene::Scene &scene) {
        scene.tone.low.reset();
        scene.tone.high.reset();
    });
}

void ProjectionView::fitView() {
    m_body = m_tone.exposure();
    m_document.setPose(fittedToBody(m_document.pose()));
}

void ProjectionView::fitOrResetView() {
    m_body = m_tone.exposure();
    if (fittedToBody(m_document.pose()) == m_document.pose())
        resetView();
    else
        fitView();
}

void ProjectionView::setOrbitsCrosshair(bool isAboutCrosshair) {
    m_orbitsCrosshair = isAboutCrosshair;
    m_overlay->setShowsCrosshair(isAboutCrosshair);
}

glm::dvec3 ProjectionView::pivotMm() const {
    return m_orbitsCrosshair && m_document.volume()
               ? m_document.crosshair().mm - m_document.volume()->lattice().center().mm
               : 0.5 * (m_body.lowMm + m_body.highMm);
}

Pose ProjectionView::fittedToBody(const Pose &pose) const {
    return fitted(pose, m_body.lowMm, m_body.highMm, m_document.fittingPixelMm(), sizeInPixels());
}

void ProjectionView::showStandardView(scene::StandardView view) {
    showOrientation(scene::viewOrientation(view));
}

void ProjectionView::showOrientation(const glm::dquat &orientation) {
    const Pose turned = turnedTo(m_document.pose(), orientation, pivotMm());
    m_document.setPose(turned.isFitted ? fittedToBody(turned) : turned);
}

void ProjectionView::setComparing(bool isComparing) {
    m_isComparing = isComparing && m_frame && m_comparison.before();
    if (m_isComparing)
        requestFrame(false);
    else
        m_overlay->setComparison({}, {});
}

void ProjectionView::showComparison() {
    if (!m_isComparing || !m_frame->compared || !m_comparison.before())
        return;
    const ShownLook &before = *m_comparison.before();
    try {
        const QImage now = picture();
        const auto rgba = picture::compose(
            *m_frame->compared, picture::displayOf(before.tone, m_frame->camera.orientation));
        const QImage then(rgba.data(), m_frame->compared->width, m_frame->compared->height,
                          QImage::Format_RGBA8888);
        m_overlay->setComparison(besideEachOther(then.scaled(now.size()), now), before.name);
    } catch (const task::Error &error) { // the card that held the picture failed
        setComparing(false);
        setMessage(translated(error.reason()));
    }
}

void ProjectionView::requestFrame(bool moving) {
    m_check.stop();
    m_meter.cancel();
    if (!m_prepared)
        return;
    const bool draft = moving && m_fullFrameMs > smoothFrameMs;
    m_pending = true;
    const plan::RenderPlan &plan = m_prepared->plan;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // The picture that this one is compared with may be read by one kernel.
    const bool isAdaptive = plan.adaptiveError > 0.0 && !m_onCard && !m_isComparing;
    const double finest = isAdaptive ? 0.0
                                     : std::min(lattice.shortestStepMm() / pixelsPerVoxel,
                                                2.0 * lattice.radiusMm() / pixelsAcross);
    shading::Shading shading = m_document.scene().shading;
    if (shading.isLit() && !m_prepared->canBeLit) // until light is prepared, the shading stays
        shading = m_drawnShading;
    else
        m_tone.follow(shading, m_document.scene());
    m_drawnShading = shading;
    std::optional<RenderWorker::Compared> compared;
    if (const auto &before = m_comparison.before(); m_isComparing && before)
        compared = {before->engine, before->image, before->shading};
    std::optional<RenderWorker::Exposed> exposed;
    if (m_tone.isWanted())
        exposed = {lattice, m_document.scene().tone, picture::ToneSubject(m_document.scene()),
                   picture::backgroundOf(*m_document.volume())};
    m_requested = m_worker.request(m_document.scene().camera, m_document.scene().image, shading,
                                   {.draft = draft, .finestPixelMm = finest}, exposed, compared);
    if (moving)
        m_rest.start();
}

void ProjectionView::takeFrame(const std::shared_ptr<const RenderedFrame> &frame) {
    if (!m_prepared ||
        frame->generation != m_generation) // of a closed volume, or of the coarse engine
        return;
    // It was requested before the exposure was: the next frame has one.
    if (m_tone.isWanted() && !frame->exposure)
        return;
    if (frame->exposure) {
        m_tone.take(*frame->exposure);
        // Another request, which measured again, may have been replaced meanwhile. Weights that
        // move keep the exposure.
        picture::ToneSubject now(m_document.scene());
        now.look = frame->exposed.look;
        if (now != frame->exposed) {
            m_tone.retake();
            requestFrame(m_rest.isActive());
        }
    }
    if (std::exchange(m_fitsNext, false)) {
        m_body = m_tone.exposure();
        const Pose now = m_document.pose(), pose = fittedToBody(now);
        const bool isNew = now.isFitted && now.zoom == 1.0 && now.panMm == glm::dvec2(0.0);
        if (isNew && !(pose == now)) {
            m_document.setPose(pose); // and its own frame follows
            return;
        }
    }
    m_frame = frame;
    m_frameError = prepare::boundOf(*m_prepared, m_document.scene().image);
    m_frameStage = m_stage;
    m_pending = m_rest.isActive() || frame->number != m_requested;
    if (!frame->draft) {
        m_fullFrameMs = frame->times.totalMs() / (m_isFirstFrame ? firstFrameFactor : 1.0);
        m_isFirstFrame = false;
    }
    if (frame->onCard)
        m_canvas->setPicture(frame->onCard);
    else
        m_canvas->setImage({frame, &frame->image});
    updateTone();
    showTexts();
    emit frameShown(frame->times, frame->draft);
    const task::Reason engine =
        frame->onCard && m_onCard ? m_onCard->description() : m_prepared->engine->description();
    emit engineDescribed(
        tr("%1: %2").arg(translated(engine), translated(frame->refusal.value_or(m_engineReason))));
    if (showsFinalImage()) {
        if (m_planState == PlanState::holds) {
            m_document.setExposure(m_tone.exposure());
            m_comparison.settled({m_prepared->engine, m_document.scene().image, m_drawnShading,
                                  shownTone(), m_lookName});
        }
        emit finalImageShown();
    }
    showComparison();
    if (!frame->draft && !m_pending)
        m_check.start();
}

// Not while the engine that follows is being prepared: the processor has enough to do.
void ProjectionView::measureError() {
    if (!m_frame || !m_prepared || !m_prepared->study || m_pending ||
        m_planState == PlanState::underway)
        return;
    std::shared_ptr<render::ProjectionEngine> engine = m_prepared->engine;
    if (m_frame->onCard && m_onCard)
        engine = m_onCard;
    shading::Shading shading = m_drawnShading;
    if (!m_prepared->canBeLit)
        shading.lights.clear();
    const scene::ImageDefinition &image = m_document.scene().image;
    m_meter.measure({m_worker.period(engine, m_frame->camera, image, shading), m_prepared->study,
                     shading::shadingScale(m_document.volume()->lattice()), image, shading,
                     m_frame->number});
}

scene::Tone ProjectionView::shownTone() const {
    return m_tone.completed(m_document.scene().tone);
}

picture::Display ProjectionView::shownDisplay() const {
    return picture::displayOf(shownTone(), m_frame ? m_frame->camera.orientation
                                                   : m_document.scene().camera.orientation);
}

picture::ToneRange ProjectionView::shownRange() const {
    return shownDisplay().range;
}

picture::ToneRange ProjectionView::automaticRange() const {
    const scene::Tone automatic = m_tone.completed({});
    return picture::displayOf(automatic, m_document.scene().camera.orientation).range;
}

void ProjectionView::updateTone() {
    m_canvas->setDisplay(shownDisplay());
}

QImage ProjectionView::picture() const {
    if (!m_frame)
        return {};
    const auto shown = [&](const picture::ProjectionImage &image) {
        const auto rgba = picture::compose(image, shownDisplay());
        return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
    };
    return m_frame->onCard ? shown(m_frame->onCard->download()) : shown(m_frame->image);
}

bool ProjectionView::showsWhatIsAskedFor() const {
    return m_document.volume() && showsFinalImage() && m_planState == PlanState::holds;
}

scene::Scene ProjectionView::sceneOfPicture(int scale) const {
    scene::Scene scene = m_document.scene();
    scene.camera.width *= scale;
    scene.camera.height *= scale;
    scene.camera.pixelMm /= scale;
    scene.tone = shownTone();
    scene.plannedFor = scene::PlannedFor::volume;
    scene.isOfDifference = m_document.volume() && m_document.volume()->notes().isDifference;
    return scene;
}

std::function<picture::ProjectionImage(const scene::Camera &)> ProjectionView::pictureRenderer() {
    return
        [this, engine = m_prepared ? m_prepared->engine : nullptr, image = m_document.scene().image,
         shading = m_drawnShading](const scene::Camera &camera) {
            return m_worker.picture(engine, camera, image, shading).get();
        };
}

void ProjectionView::paintAnnotations(QPainter &painter, const scene::Camera &camera,
                                      Names names) const {
    m_overlay->paint(painter, mappingOf(camera),
                     names == Names::shown ? Marks::plain : Marks::nameless, names);
}

scene::Camera ProjectionView::turnedAroundPatient(const scene::Camera &camera,
                                                  double degrees) const {
    const Pose pose = ui::turnedAroundPatient(m_document.pose(), degrees, pivotMm());
    scene::Camera turned = camera;
    turned.orientation = pose.orientation;
    turned.panMm = pose.panMm;
    return turned;
}

QSizeF ProjectionView::sizeInPixels() const {
    return QSizeF(size()) * devicePixelRatioF();
}

void ProjectionView::resizeEvent(QResizeEvent *) {
    m_isFirstFrame = true;
    m_canvas->widget()->setGeometry(rect());
    m_overlay->setGeometry(rect());
    m_document.setProjectionSize(sizeInPixels());
    if (m_document.pose().isFitted && m_frame)
        m_document.setPose(fittedToBody(m_document.pose()));
}

PaneMapping ProjectionView::mapping() const {
    return mappingOf(m_document.scene().camera);
}

PaneMapping ProjectionView::mappingOf(const scene::Camera &camera) const {
    PaneMapping mapping;
    mapping.pixelRatio = devicePixelRatioF();
    const glm::dmat3 axes = camera.axes();
    mapping.plane = {{}, {axes[0], axes[1]}, camera.pixelMm, camera.width, camera.height};
    if (m_document.volume())
        mapping.plane.center = {m_document.volume()->lattice().center().mm +
                                camera.panMm.x * axes[0] + camera.panMm.y * axes[1]};
    return mapping;
}

void ProjectionView::turnAroundPatient(double degrees) {
    m_document.setPose(ui::turnedAroundPatient(m_document.pose(), degrees, pivotMm()), true);
}

void ProjectionView::lookAlong(const glm::dvec3 &right, const glm::dvec3 &up) {
    const glm::dquat orientation = glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up)));
    showOrientation(orientation);
}

void ProjectionView::showTexts() {
    const QString message = m_waiting == Waiting::underway ? tr("Preparing the projection")
                            : m_waiting == Waiting::cancelled
                                ? tr("Cancelled: there is no projection")
                                : m_message;
    ProjectionOverlay::Texts texts{m_lookName, message, {}};
    if (m_frame)
        texts.figures = figuresText({*m_frame, m_frameError, m_frameStage, m_planState, m_pending});
    m_overlay->setTexts(texts);
}

} // namespace pellucid::ui
