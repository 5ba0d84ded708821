// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_view.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <glm/geometric.hpp>

#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/language/reasons.h"
#include "ui/views/camera_moves.h"
#include "ui/views/overlay.h"
#include "ui/views/projection_overlay.h"

namespace pellucid::ui {

namespace {

// Full frames slower than this would lag behind the hand; drafts are drawn instead while it moves.
constexpr double smoothFrameMs = 35.0;
constexpr int restMs = 120;
// Beyond this a finer picture shows the reconstruction's smoothness, not the patient.
constexpr double samplesPerPixel = 4.0;

// No more digits than are known.
QString errorText(double error) {
    const double percent = 100.0 * error;
    if (percent >= 100.0) // of a part that shows next to nothing
        return QObject::tr("error over 100 %");
    return QObject::tr("error %1 %")
        .arg(percent < 1.0 ? QString::number(percent, 'f', 3) : QString::number(percent, 'g', 2));
}

QString withError(const QString &stage, const QString &error) {
    return error.isEmpty() ? stage : QObject::tr("%1, %2").arg(stage, error);
}

} // namespace

ProjectionView::ProjectionView(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_canvas(makeProjectionCanvas(this)),
      m_measure(document, true), m_overlay(new ProjectionOverlay(document, m_measure, this)),
      m_comparison(document) {
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
        if (m_document.volume() && m_document.isPreview())
            return;
        // What was projected belongs to another volume.
        m_prepared.reset();
        m_onCard.reset();
        m_worker.setEngine(std::nullopt, nullptr, ++m_generation);
        m_planState = PlanState::holds;
        m_measure.cancel();
        m_comparison.forget();
        setComparing(false);
        if (m_tone.outlivesVolume(m_document.volume().has_value()))
            return;
        m_frame.reset();
        m_drawnShading = {};
        m_message = m_document.volume() ? tr("Preparing the projection") : QString();
        m_canvas->setImage({});
        m_zoom = 1.0;
        fitCamera();
        showTexts();
    });
    connect(&document, &Document::crosshairChanged, this, [this] {
        if (m_orbitsCrosshair)
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
    scene::Camera camera = m_document.scene().camera;
    camera.orientation = wanted.orientation;
    camera.panMm = pannedTo(wanted, pivotMm.value_or(this->pivotMm()), this->pivotMm());
    m_document.setCamera(camera);
    m_zoom = std::clamp(fittingPixelMm() / wanted.pixelMm, 0.2, 20.0);
    fitCamera();
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

double ProjectionView::fittingPixelMm() const {
    const double ratio = devicePixelRatioF();
    const double side = std::max(1.0, std::min(width(), height()) * ratio);
    // The outer seventh of the sphere around a scan holds only the corners of its box, which are
    // air.
    return m_document.volume() ? 2.0 * m_document.volume()->lattice().radiusMm() / side * 0.86
                               : 1.0;
}

void ProjectionView::fitCamera() {
    scene::Camera camera = m_document.scene().camera;
    const double ratio = devicePixelRatioF();
    camera.width = std::max(2, int(std::lround(width() * ratio)));
    camera.height = std::max(2, int(std::lround(height() * ratio)));
    camera.pixelMm = fittingPixelMm() / m_zoom;
    m_document.setCamera(camera);
}

void ProjectionView::resetView() {
    m_zoom = 1.0;
    scene::Camera camera = m_document.scene().camera;
    camera.orientation = scene::viewOrientation(scene::StandardView::front);
    camera.panMm = {0.0, 0.0};
    m_document.setCamera(camera);
    fitCamera();
    requestFrame(false);
    scene::Scene scene = m_document.scene();
    if (scene.tone.low || scene.tone.high) {
        scene.tone.low.reset();
        scene.tone.high.reset();
        m_document.undoStack()->push(new EditScene(m_document, scene, tr("Reset window")));
    }
}

void ProjectionView::moveCamera(const scene::Camera &camera, bool moving) {
    m_document.setCamera(camera);
    requestFrame(moving);
}

glm::dvec3 ProjectionView::pivotMm() const {
    return m_orbitsCrosshair && m_document.volume()
               ? m_document.crosshair().mm - m_document.volume()->lattice().center().mm
               : glm::dvec3(0.0);
}

void ProjectionView::setOrbitsCrosshair(bool isAboutCrosshair) {
    m_orbitsCrosshair = isAboutCrosshair;
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
        !m_prepared->takesLight) // it is being prepared: all stays as it is till then
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
    m_overlay->paint(painter, mapping(camera), MeasureTool::Marks::plain, names);
}

scene::Camera ProjectionView::turnedAroundPatient(const scene::Camera &camera,
                                                  double degrees) const {
    return ui::turnedAroundPatient(camera, degrees, pivotMm());
}

void ProjectionView::resizeEvent(QResizeEvent *) {
    m_canvas->widget()->setGeometry(rect());
    m_overlay->setGeometry(rect());
    fitCamera();
    requestFrame(false);
}

PaneMapping ProjectionView::mapping() const {
    return mapping(m_document.scene().camera);
}

PaneMapping ProjectionView::mapping(const scene::Camera &camera) const {
    PaneMapping mapping;
    mapping.pixelRatio = devicePixelRatioF();
    const glm::dmat3 axes = camera.axes();
    mapping.plane = {{}, {axes[0], axes[1]}, camera.pixelMm, camera.width, camera.height};
    if (m_document.volume())
        mapping.plane.center = {m_document.volume()->lattice().center().mm +
                                camera.panMm.x * axes[0] + camera.panMm.y * axes[1]};
    return mapping;
}

void ProjectionView::setTool(Tool tool) {
    m_tool = tool;
    m_measure.cancel();
    showCursor();
}

void ProjectionView::showCursor() {
    if (m_tool == Tool::distance)
        setCursor(Qt::CrossCursor);
    else
        unsetCursor();
}

void ProjectionView::mousePressEvent(QMouseEvent *event) {
    setFocus();
    if (m_measure.isBusy()) // a second button does not disturb what the first one drags
        return;
    if (event->button() == Qt::LeftButton && m_frame &&
        m_measure.press({mapping(), 0.0}, event->position(),
                        m_tool == Tool::distance ? std::optional(measure::Kind::projectedDistance)
                                                 : std::nullopt)) {
        m_button = Qt::NoButton;
        m_overlay->update();
        return;
    }
    m_button = event->button();
    m_last = event->position().toPoint();
    m_drag = nextDragId();
    setCursor(m_button == Qt::LeftButton     ? Qt::ClosedHandCursor
              : m_button == Qt::MiddleButton ? Qt::SizeAllCursor
                                             : Qt::ArrowCursor);
}

void ProjectionView::mouseMoveEvent(QMouseEvent *event) {
    const QPoint position = event->position().toPoint(), delta = position - m_last;
    m_last = position;
    if (m_measure.isBusy()) {
        m_measure.move({mapping(), 0.0}, event->position());
        m_overlay->update();
        return;
    }
    if (!m_prepared || delta.isNull())
        return;
    if (m_button == Qt::LeftButton)
        orbit(delta);
    else if (m_button == Qt::MiddleButton)
        moveCamera(panned(m_document.scene().camera, delta, devicePixelRatioF()), true);
    else if (m_button == Qt::RightButton)
        windowBy(delta);
}

void ProjectionView::mouseReleaseEvent(QMouseEvent *event) {
    if (m_measure.isBusy() && event->button() == Qt::LeftButton)
        m_measure.release({mapping(), 0.0}, event->position());
    m_button = Qt::NoButton;
    showCursor();
    m_overlay->update();
}

void ProjectionView::mouseDoubleClickEvent(QMouseEvent *event) {
    if (event->button() == Qt::LeftButton)
        emit maximizeRequested(this);
}

void ProjectionView::orbit(const QPoint &delta) {
    moveCamera(orbited(m_document.scene().camera, delta, pivotMm()), true);
}

void ProjectionView::turnAroundPatient(double degrees) {
    moveCamera(turnedAroundPatient(m_document.scene().camera, degrees), true);
}

void ProjectionView::lookAlong(const glm::dvec3 &right, const glm::dvec3 &up) {
    const glm::dquat orientation = glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up)));
    moveCamera(turnedTo(m_document.scene().camera, orientation, pivotMm()), false);
}

void ProjectionView::windowBy(const QPoint &delta) {
    scene::Scene scene = m_document.scene();
    const picture::ToneRange &automatic = m_tone.range();
    const scene::Tone shown = shownTone();
    const double low = *shown.low, high = *shown.high;
    const double perPixel = (automatic.high - automatic.low) / 300.0;
    const double center = 0.5 * (low + high) - delta.y() * perPixel;
    const double width = std::max(high - low + delta.x() * perPixel, 2.0 * perPixel);
    scene.tone.low = center - 0.5 * width;
    scene.tone.high = center + 0.5 * width;
    m_document.undoStack()->push(new EditScene(m_document, scene, tr("Projection window"), m_drag));
}

void ProjectionView::zoomBy(double factor) {
    m_zoom = std::clamp(m_zoom * factor, 0.2, 20.0);
    fitCamera();
    requestFrame(true);
}

void ProjectionView::wheelEvent(QWheelEvent *event) {
    if (event->angleDelta().y() != 0)
        zoomBy(event->angleDelta().y() > 0 ? 1.15 : 1.0 / 1.15);
    event->accept();
}

bool ProjectionView::event(QEvent *event) {
    // The keypad belongs to the views here, not to the window presets of the same digits.
    if (event->type() == QEvent::ShortcutOverride &&
        (static_cast<QKeyEvent *>(event)->modifiers() & Qt::KeypadModifier) != 0) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void ProjectionView::keyPressEvent(QKeyEvent *event) {
    using scene::StandardView;
    const bool keypad = (event->modifiers() & Qt::KeypadModifier) != 0;
    const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
    // With Shift, or without Num Lock, keypad digits arrive as the keys printed below them.
    if (keypad && (event->key() == Qt::Key_1 || event->key() == Qt::Key_End))
        showStandardView(shift ? StandardView::back : StandardView::front);
    else if (keypad && (event->key() == Qt::Key_3 || event->key() == Qt::Key_PageDown))
        showStandardView(shift ? StandardView::right : StandardView::left);
    else if (keypad && (event->key() == Qt::Key_7 || event->key() == Qt::Key_Home))
        showStandardView(shift ? StandardView::bottom : StandardView::top);
    else if ((keypad && (event->key() == Qt::Key_0 || event->key() == Qt::Key_Insert)) ||
             event->key() == Qt::Key_R)
        resetView();
    else if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right)
        orbit({event->key() == Qt::Key_Left ? -11 : 11, 0}); // about five degrees
    else if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down)
        orbit({0, event->key() == Qt::Key_Up ? -11 : 11});
    else if (event->key() == Qt::Key_Escape && m_measure.isBusy())
        m_measure.cancel();
    else
        QWidget::keyPressEvent(event);
}

void ProjectionView::showTexts() {
    ProjectionOverlay::Texts texts{m_lookName, m_message, {}};
    if (m_frame) {
        // The error is that of the picture, which may still be the former engine's. It is not
        // computed while the view moves.
        const QString error = m_frameError ? errorText(*m_frameError)
                              : m_pending  ? QString()
                                           : tr("error not known yet");
        const QString quality =
            m_planState == PlanState::cancelled   ? tr("cancelled: F5 prepares it")
            : m_planState == PlanState::failed    ? tr("not prepared: F5 tries again")
            : m_frameStage == EngineStage::coarse ? withError(tr("coarse"), error)
            : m_frameStage == EngineStage::live   ? withError(tr("live"), error)
            : m_planState == PlanState::underway  ? tr("error not known yet")
                                                  : error;
        texts.figures = QString("%1  %2  %3")
                            .arg(m_frame->onCard ? "GPU" : "CPU")
                            .arg(millisecondsText(m_frame->times.totalMs()))
                            .arg(m_frame->draft ? tr("draft") : quality);
    }
    m_overlay->setTexts(texts);
}

} // namespace pellucid::ui
