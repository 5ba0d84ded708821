// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_view.h"

#include <glm/geometric.hpp>

#include "core/task/error.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/views/camera_moves.h"
#include "ui/views/projection_overlay.h"
#include "ui/views/projection_texts.h"

namespace pellucid::ui {

namespace {

// Full frames slower than this would lag behind the hand; drafts are drawn instead while it moves.
constexpr double smoothFrameMs = 35.0;
constexpr int restMs = 120;
// Beyond this a finer picture shows the reconstruction's smoothness, not the patient.
constexpr double samplesPerPixel = 4.0;

} // namespace

ProjectionView::ProjectionView(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_canvas(makeProjectionCanvas(this)),
      m_camera(document, *this), m_tools(document, *this),
      m_overlay(new ProjectionOverlay(document, m_tools.measure(), this)), m_comparison(document) {
    setObjectName("projectionView");
    setAccessibleName(tr("Projection"));
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(200, 160);
    m_canvas->widget()->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_overlay->raise();
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] { requestFrame(false); });
    connect(&m_worker, &RenderWorker::frameReady, this, &ProjectionView::takeFrame);
    connect(&m_worker, &RenderWorker::failed, this, [this](const task::Reason &reason) {
        m_pending = false;
        setMessage(translated(reason));
    });
    connect(&m_worker, &RenderWorker::cardFailed, this, &ProjectionView::cardFailed);
    connect(&document, &Document::volumeChanged, this, [this] {
        if (!m_document.volume() || !m_document.isPreview())
            forgetVolume();
    });
    connect(&document, &Document::crosshairChanged, this, [this] {
        if (orbitsCrosshair())
            m_overlay->update();
    });
    connect(&document, &Document::cameraChanged, this,
            [this] { m_overlay->setMapping(mapping()); });
    for (const auto changed :
         {&Document::measurementsChanged, &Document::selectedMeasurementChanged})
        connect(&document, changed, this, [this] { m_overlay->update(); });
    connect(&document, &Document::sceneChanged, this, [this] {
        updateTone();
        requestFrame(false);
    });
}

ProjectionView::~ProjectionView() {
    // The canvas is also a child widget: it goes before the base class deletes its children.
    m_canvas.reset();
}

// What was projected belongs to another volume.
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
    m_drawnShading = {};
    m_message = m_document.volume() ? tr("Preparing the projection") : QString();
    m_canvas->setImage({});
    m_camera.fitWhole();
    showTexts();
}

void ProjectionView::setEngine(const ShownEngine &shown, EngineStage stage) {
    if (m_prepared && m_prepared->engine == shown.prepared.engine && m_onCard == shown.onCard &&
        m_stage == stage && m_engineReason == shown.reason) {
        // The same engine comes again when the detail that it lacks is known: only the figure
        // changes, so frames that are underway remain valid.
        m_prepared = shown.prepared;
        m_worker.setEngine(shown.prepared, shown.onCard, m_generation);
        requestFrame(m_rest.isActive());
        return;
    }
    m_prepared = shown.prepared;
    m_predictedError = shown.predictedError;
    m_message.clear();
    // Weights that move change the brightness, and are meant to; another field, or the fine one
    // after the coarse one, has a brightness of its own.
    const bool sameFields = stage == EngineStage::live || stage == EngineStage::settled;
    if (!sameFields) {
        m_tone.beginFields(m_document.scene());
        m_fullFrameMs = 0.0;
    }
    // Frames of the weights of a moment ago are shown: the hand may be faster than they are.
    if (stage != EngineStage::live || m_stage != EngineStage::live)
        ++m_generation;
    m_stage = stage;
    m_worker.setEngine(shown.prepared, shown.onCard, m_generation);
    m_onCard = shown.onCard;
    m_engineReason = shown.reason;
    requestFrame(false);
}

void ProjectionView::jobEnded() {
    if (m_document.volume() && !m_prepared && m_message == tr("Preparing the projection"))
        setMessage(tr("Cancelled: there is no projection"));
}

void ProjectionView::jobStarted() {
    if (m_document.volume() && !m_prepared && m_message == tr("Cancelled: there is no projection"))
        setMessage(tr("Preparing the projection"));
}

void ProjectionView::adoptCamera(const scene::Camera &wanted,
                                 const std::optional<glm::dvec3> &pivotMm) {
    m_camera.adopt(wanted, pivotMm);
    requestFrame(true); // another view may be moving with it
}

void ProjectionView::setLookName(const QString &name) {
    m_lookName = name;
    showTexts();
}

void ProjectionView::holdTone() {
    if (m_frame)
        m_tone.hold();
}

void ProjectionView::adoptTone(const picture::ToneRange &range) {
    m_tone.adopt(range, m_document.scene());
    m_document.setBrightness(range);
    updateTone();
}

void ProjectionView::retakeTone() {
    m_tone.retake();
    requestFrame(false);
}

void ProjectionView::setPlanState(PlanState state) {
    m_planState = state;
    showTexts();
}

void ProjectionView::setMessage(const QString &message) {
    m_message = message;
    showTexts();
}

void ProjectionView::resetView() {
    m_camera.reset();
    requestFrame(false);
    editScene(m_document, tr("Reset window"), noDrag, [](scene::Scene &scene) {
        scene.tone.low.reset();
        scene.tone.high.reset();
    });
}

void ProjectionView::moveCamera(const scene::Camera &camera, bool moving) {
    m_document.setCamera(camera);
    requestFrame(moving);
}

void ProjectionView::setOrbitsCrosshair(bool isAboutCrosshair) {
    m_camera.setOrbitsCrosshair(isAboutCrosshair);
    m_overlay->setShowsCrosshair(isAboutCrosshair);
}

void ProjectionView::showStandardView(scene::StandardView view) {
    moveCamera(turnedTo(m_document.scene().camera, scene::viewOrientation(view), pivotMm()), false);
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
        const auto rgba = picture::compose(*m_frame->compared, before.tone);
        const QImage then(rgba.data(), m_frame->compared->width, m_frame->compared->height,
                          QImage::Format_RGBA8888);
        m_overlay->setComparison(besideEachOther(then.scaled(now.size()), now), before.name);
    } catch (const task::Error &error) { // the card went with the picture
        setComparing(false);
        setMessage(translated(error.reason()));
    }
}

void ProjectionView::requestFrame(bool moving) {
    if (!m_prepared)
        return;
    const bool draft = moving && m_fullFrameMs > smoothFrameMs;
    m_pending = true;
    const double finest = m_document.volume()->lattice().shortestStepMm() / samplesPerPixel;
    shading::Shading shading = m_document.scene().shading;
    if (shading.isLit() &&
        !m_prepared->canBeLit) // it is being prepared: all stays as it is till then
        shading = m_drawnShading;
    else
        m_tone.follow(shading);
    m_drawnShading = shading;
    std::optional<RenderWorker::Compared> compared;
    if (const auto &before = m_comparison.before(); m_isComparing && before)
        compared = {before->engine, before->image, before->shading};
    m_requested = m_worker.request(m_document.scene().camera, m_document.scene().image, shading,
                                   {.draft = draft, .finestPixelMm = finest}, m_tone.isWanted(),
                                   !moving, compared);
    if (moving)
        m_rest.start();
}

void ProjectionView::takeFrame(const std::shared_ptr<const RenderedFrame> &frame) {
    if (!m_prepared ||
        frame->generation != m_generation) // of a volume that was closed, or the coarse one's
        return;
    // Asked for before the brightness was to be taken anew: the next one tells it.
    if (m_tone.isWanted() && !frame->automaticTone)
        return;
    m_frame = frame;
    // A full frame from the card has only the plan's error.
    m_frameError = frame->onCard && !m_prepared->isCoarse ? m_predictedError : frame->error;
    m_frameStage = m_stage;
    m_pending = m_rest.isActive() || frame->number != m_requested;
    if (!frame->draft)
        m_fullFrameMs = frame->times.totalMs();
    if (m_tone.isWanted())
        m_tone.take(*frame->automaticTone);
    if (frame->onCard)
        m_canvas->setPicture(frame->onCard);
    else
        m_canvas->setImage(frame->image);
    updateTone();
    showTexts();
    emit frameShown(frame->times, frame->draft);
    const task::Reason engine =
        frame->onCard && m_onCard ? m_onCard->description() : m_prepared->engine->description();
    emit engineDescribed(
        tr("%1: %2").arg(translated(engine), translated(frame->refusal.value_or(m_engineReason))));
    if (showsFinalImage()) {
        if (m_planState == PlanState::holds) {
            m_document.setBrightness(m_tone.range());
            m_comparison.settled({m_prepared->engine, m_document.scene().image, m_drawnShading,
                                  shownTone(), m_lookName});
        }
        emit finalImageShown();
    }
    showComparison();
}

scene::Tone ProjectionView::shownTone() const {
    return m_tone.completed(m_document.scene().tone);
}

void ProjectionView::updateTone() {
    const scene::Tone tone = shownTone();
    m_canvas->setTone({*tone.low, *tone.high}, tone.inverted);
}

QImage ProjectionView::picture() const {
    if (!m_frame)
        return {};
    const picture::ProjectionImage image =
        m_frame->onCard ? m_frame->onCard->download() : m_frame->image;
    const auto rgba = picture::compose(image, shownTone());
    return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
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
    m_overlay->paint(painter, m_camera.mapping(camera), Marks::plain, names);
}

scene::Camera ProjectionView::turnedAroundPatient(const scene::Camera &camera,
                                                  double degrees) const {
    return ui::turnedAroundPatient(camera, degrees, pivotMm());
}

void ProjectionView::resizeEvent(QResizeEvent *) {
    m_canvas->widget()->setGeometry(rect());
    m_overlay->setGeometry(rect());
    m_camera.fit();
    requestFrame(false);
}

PaneMapping ProjectionView::mapping() const {
    return m_camera.mapping(m_document.scene().camera);
}

void ProjectionView::turnAroundPatient(double degrees) {
    moveCamera(turnedAroundPatient(m_document.scene().camera, degrees), true);
}

void ProjectionView::lookAlong(const glm::dvec3 &right, const glm::dvec3 &up) {
    const glm::dquat orientation = glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up)));
    moveCamera(turnedTo(m_document.scene().camera, orientation, pivotMm()), false);
}

void ProjectionView::showTexts() {
    ProjectionOverlay::Texts texts{m_lookName, m_message, {}};
    if (m_frame)
        texts.figures = figuresText({*m_frame, m_frameError, m_frameStage, m_planState, m_pending});
    m_overlay->setTexts(texts);
}

} // namespace pellucid::ui
