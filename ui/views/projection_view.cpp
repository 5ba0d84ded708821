// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/projection_view.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include "ui/document.h"
#include "ui/overlay.h"

namespace pellucid::ui {

namespace {

// Full frames slower than this would lag behind the hand; drafts are drawn instead while it moves.
constexpr double smoothFrameMs = 35.0;
constexpr int restMs = 120;
// Beyond this a finer picture shows the reconstruction's smoothness, not the patient.
constexpr double samplesPerPixel = 4.0;
constexpr double radiansPerPixel = 0.008;

} // namespace

// Drawn over the canvas, which may be an OpenGL surface.
class ProjectionView::Overlay : public QWidget {
public:
    explicit Overlay(ProjectionView *view) : QWidget(view), m_view(view) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setAttribute(Qt::WA_NoSystemBackground);
    }

protected:
    void paintEvent(QPaintEvent *) override {
        QPainter painter(this);
        m_view->paintOverlay(painter);
    }

private:
    ProjectionView *m_view;
};

ProjectionView::ProjectionView(Document &document, QWidget *parent)
    : QWidget(parent), m_document(document), m_canvas(makeProjectionCanvas(this)),
      m_overlay(new Overlay(this)) {
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
    connect(&m_worker, &RenderWorker::failed, this, [this](const QString &reason) {
        m_pending = false;
        setMessage(reason);
    });
    connect(&m_worker, &RenderWorker::cardFailed, this, &ProjectionView::cardFailed);
    connect(&document, &Document::volumeChanged, this, [this] {
        if (m_document.volume() && m_document.isPreview())
            return;
        // What was projected belongs to another volume.
        m_engine.reset();
        m_worker.setEngine(nullptr, nullptr, ++m_generation);
        m_frame.reset();
        m_drawnShading = {};
        m_automaticTone.reset();
        m_message = m_document.volume() ? tr("Preparing the projection") : QString();
        m_canvas->setImage({});
        m_zoom = 1.0;
        fitCamera();
        m_overlay->update();
    });
    connect(&document, &Document::cameraChanged, this, [this] { m_overlay->update(); });
    connect(&document, &Document::sceneChanged, this, [this] {
        // Another number of lights or kind of cue has a brightness of its own; what the hand drags
        // keeps it.
        const shading::Shading &shading = m_document.scene().shading;
        if (shading.lights.size() != m_drawnShading.lights.size() ||
            shading.cue.kind != m_drawnShading.cue.kind)
            m_automaticTone.reset();
        updateTone();
        requestFrame(false);
        m_overlay->update();
    });
}

ProjectionView::~ProjectionView() {
    // The canvas is also a child widget: it goes before the base class deletes its children.
    m_canvas.reset();
}

void ProjectionView::setEngine(const ShownEngine &shown, EngineStage stage) {
    m_engine = shown.prepared.engine;
    m_takesLight = shown.prepared.takesLight;
    m_planState = PlanState::holds;
    m_predictedError = shown.predictedError;
    m_message.clear();
    // Weights that move change the brightness, and are meant to; another field, or the fine one
    // after the coarse one, has a brightness of its own.
    const bool sameFields = stage == EngineStage::live || stage == EngineStage::settled;
    if (!sameFields) {
        m_automaticTone.reset();
        m_fullFrameMs = 0.0;
    }
    // Frames of the weights of a moment ago are shown: the hand may be faster than they are.
    if (stage != EngineStage::live || m_stage != EngineStage::live)
        ++m_generation;
    m_stage = stage;
    m_worker.setEngine(m_engine, shown.onCard, m_generation);
    m_onCard = shown.onCard;
    m_engineReason = shown.reason;
    requestFrame(false);
}

void ProjectionView::jobEnded() {
    if (m_document.volume() && !m_engine && m_message == tr("Preparing the projection"))
        setMessage(tr("Cancelled: there is no projection"));
}

void ProjectionView::jobStarted() {
    if (m_document.volume() && !m_engine && m_message == tr("Cancelled: there is no projection"))
        setMessage(tr("Preparing the projection"));
}

void ProjectionView::adoptCamera(const render::Camera &wanted) {
    render::Camera camera = m_document.scene().camera;
    camera.orientation = wanted.orientation;
    camera.panMm = wanted.panMm;
    m_document.setCamera(camera);
    m_zoom = std::clamp(fittingPixelMm() / wanted.pixelMm, 0.2, 20.0);
    fitCamera();
    requestFrame(false);
}

void ProjectionView::setLookName(const QString &name) {
    m_lookName = name;
    m_overlay->update();
}

void ProjectionView::retakeTone() {
    m_automaticTone.reset();
    requestFrame(false);
}

void ProjectionView::setPlanState(PlanState state) {
    m_planState = state;
    m_overlay->update();
}

void ProjectionView::setMessage(const QString &message) {
    m_message = message;
    m_overlay->update();
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
    render::Camera camera = m_document.scene().camera;
    const double ratio = devicePixelRatioF();
    camera.width = std::max(2, int(std::lround(width() * ratio)));
    camera.height = std::max(2, int(std::lround(height() * ratio)));
    camera.pixelMm = fittingPixelMm() / m_zoom;
    m_document.setCamera(camera);
}

void ProjectionView::resetView() {
    m_zoom = 1.0;
    render::Camera camera = m_document.scene().camera;
    camera.orientation = render::viewOrientation(render::StandardView::front);
    camera.panMm = {0.0, 0.0};
    m_document.setCamera(camera);
    fitCamera();
    requestFrame(false);
    render::Scene scene = m_document.scene();
    if (scene.tone.low || scene.tone.high) {
        scene.tone.low.reset();
        scene.tone.high.reset();
        m_document.undoStack()->push(new EditScene(m_document, scene, tr("Reset window")));
    }
}

void ProjectionView::showStandardView(render::StandardView view) {
    render::Camera camera = m_document.scene().camera;
    camera.orientation = render::viewOrientation(view);
    m_document.setCamera(camera);
    requestFrame(false);
}

void ProjectionView::requestFrame(bool moving) {
    if (!m_engine)
        return;
    const bool draft = moving && m_fullFrameMs > smoothFrameMs;
    m_pending = true;
    const double finest = m_document.volume()->lattice().shortestStepMm() / samplesPerPixel;
    shading::Shading shading = m_document.scene().shading;
    if (shading.isLit() && !m_takesLight) // it is being prepared: all stays as it is till then
        shading = m_drawnShading;
    m_drawnShading = shading;
    m_requested = m_worker.request(m_document.scene().camera, m_document.scene().image, shading,
                                   {.draft = draft, .finestPixelMm = finest}, !m_automaticTone);
    if (moving)
        m_rest.start();
}

void ProjectionView::takeFrame(const std::shared_ptr<const RenderedFrame> &frame) {
    if (!m_engine ||
        frame->generation != m_generation) // of a volume that was closed, or the coarse one's
        return;
    // Asked for before the brightness was to be taken anew: the next one tells it.
    if (!m_automaticTone && !frame->automaticTone)
        return;
    m_frame = frame;
    m_frameError = m_predictedError;
    m_frameStage = m_stage;
    m_pending = m_rest.isActive() || frame->number != m_requested;
    if (!frame->draft)
        m_fullFrameMs = frame->times.totalMs();
    // The automatic range is taken once: brightness that follows the view would flicker.
    if (!m_automaticTone)
        m_automaticTone = frame->automaticTone;
    if (frame->onCard)
        m_canvas->setPicture(frame->onCard);
    else
        m_canvas->setImage(frame->image);
    updateTone();
    m_overlay->update();
    emit frameShown(frame->times, frame->draft);
    const std::string engine = frame->onCard ? m_onCard->description() : m_engine->description();
    emit engineDescribed(tr("%1: %2").arg(QString::fromStdString(engine), frame->refusal.isEmpty()
                                                                              ? m_engineReason
                                                                              : frame->refusal));
    if (showsFinalImage())
        emit finalImageShown();
}

void ProjectionView::updateTone() {
    render::ToneRange range = m_automaticTone.value_or(render::ToneRange());
    const render::Tone &tone = m_document.scene().tone;
    range.low = tone.low.value_or(range.low);
    range.high = tone.high.value_or(range.high);
    m_canvas->setTone(range, tone.inverted);
}

QImage ProjectionView::picture() const {
    if (!m_frame)
        return {};
    render::Tone tone = m_document.scene().tone;
    const render::ToneRange range = m_automaticTone.value_or(render::ToneRange());
    tone.low = tone.low.value_or(range.low);
    tone.high = tone.high.value_or(range.high);
    const render::ProjectionImage image =
        m_frame->onCard ? m_frame->onCard->download() : m_frame->image;
    const auto rgba = render::compose(image, tone);
    return QImage(rgba.data(), image.width, image.height, QImage::Format_RGBA8888).copy();
}

void ProjectionView::resizeEvent(QResizeEvent *) {
    m_canvas->widget()->setGeometry(rect());
    m_overlay->setGeometry(rect());
    fitCamera();
    requestFrame(false);
}

void ProjectionView::mousePressEvent(QMouseEvent *event) {
    setFocus();
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
    if (!m_engine || delta.isNull())
        return;
    if (m_button == Qt::LeftButton)
        orbit(delta);
    else if (m_button == Qt::MiddleButton)
        pan(delta);
    else if (m_button == Qt::RightButton)
        windowBy(delta);
}

void ProjectionView::mouseReleaseEvent(QMouseEvent *) {
    m_button = Qt::NoButton;
    unsetCursor();
}

void ProjectionView::mouseDoubleClickEvent(QMouseEvent *event) {
    if (event->button() == Qt::LeftButton)
        emit maximizeRequested(this);
}

void ProjectionView::orbit(const QPoint &delta) {
    // The side that faces the viewer follows the hand, so the camera turns the other way.
    render::Camera camera = m_document.scene().camera;
    const glm::dquat turn = glm::angleAxis(-radiansPerPixel * delta.x(), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(-radiansPerPixel * delta.y(), glm::dvec3(1, 0, 0));
    camera.orientation = glm::normalize(camera.orientation * turn);
    m_document.setCamera(camera);
    requestFrame(true);
}

void ProjectionView::pan(const QPoint &delta) {
    render::Camera camera = m_document.scene().camera;
    const double mm = camera.pixelMm * devicePixelRatioF();
    camera.panMm += glm::dvec2(-delta.x() * mm, delta.y() * mm);
    m_document.setCamera(camera);
    requestFrame(true);
}

void ProjectionView::windowBy(const QPoint &delta) {
    render::Scene scene = m_document.scene();
    const render::ToneRange automatic = m_automaticTone.value_or(render::ToneRange());
    double low = scene.tone.low.value_or(automatic.low),
           high = scene.tone.high.value_or(automatic.high);
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
    using render::StandardView;
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
    else
        QWidget::keyPressEvent(event);
}

void ProjectionView::paintOverlay(QPainter &painter) {
    const OverlayColors colors = overlayColors("accent");
    painter.fillRect(QRect(0, 0, width(), 3), colors.plane);
    const QRect inner = rect().adjusted(10, 8, -10, -8);
    const int line = painter.fontMetrics().height() + 3;
    painter.save();
    QFont bold = painter.font();
    bold.setBold(true);
    painter.setFont(bold);
    drawText(painter, inner, Qt::AlignLeft | Qt::AlignTop, tr("Projection"), colors.plane);
    painter.restore();
    drawText(painter, inner, Qt::AlignRight | Qt::AlignBottom, tr("Parallel projection"),
             colors.muted);
    const QRect second = inner.adjusted(0, line, 0, 0);
    drawText(painter, second, Qt::AlignRight | Qt::AlignTop, tr("Not for diagnostic use"),
             colors.muted);
    if (!m_document.volume())
        return;
    drawText(painter, second, Qt::AlignLeft | Qt::AlignTop, m_lookName, colors.text);
    // Warnings of the geometry stay on the image.
    QRect warning = second.adjusted(0, line, -width() / 2 - 24, 0);
    for (const std::string &w : m_document.volume()->notes().warnings) {
        drawText(painter, warning, Qt::AlignLeft | Qt::AlignTop,
                 painter.fontMetrics().elidedText(QString::fromStdString(w), Qt::ElideRight,
                                                  warning.width()),
                 colors.warning);
        warning.translate(0, line);
    }
    if (!m_message.isEmpty()) {
        painter.setPen(colors.muted);
        painter.drawText(inner.adjusted(40, 40, -40, -40), Qt::AlignCenter | Qt::TextWordWrap,
                         m_message);
    }
    if (!m_frame)
        return;
    // The error is that of the picture, which may still be the former engine's.
    const QString quality = m_planState == PlanState::givenUp     ? tr("cancelled: F5 prepares it")
                            : m_frameStage == EngineStage::coarse ? tr("coarse")
                            : m_frameStage == EngineStage::live   ? tr("live")
                            : m_planState == PlanState::underway
                                ? tr("error not known yet")
                                : tr("error %1 %").arg(100.0 * m_frameError, 0, 'f', 3);
    drawText(painter, inner, Qt::AlignRight | Qt::AlignTop,
             QString("%1  %2  %3")
                 .arg(m_frame->onCard ? "GPU" : "CPU")
                 .arg(millisecondsText(m_frame->times.totalMs()))
                 .arg(m_frame->draft ? tr("draft") : quality),
             colors.text);
    const render::Camera &camera = m_document.scene().camera;
    const glm::dmat3 axes = camera.axes();
    drawOrientationLetters(painter, rect().adjusted(0, line, 0, -line), axes[0], axes[1], colors);
    drawOrientationCube(painter, QPointF(58, height() - 58), 40, axes, colors);
    drawScaleBar(painter, QPoint(width() - 180, height() - 34),
                 1.0 / (camera.pixelMm * devicePixelRatioF()), 120, colors);
}

} // namespace pellucid::ui
