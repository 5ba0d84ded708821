// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/mpr_view.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <glm/geometric.hpp>

#include "core/mpr/reslice.h"
#include "ui/document/document.h"
#include "ui/theme/theme.h"
#include "ui/views/overlay.h"
#include "ui/views/plane_texts.h"
#include "ui/views/slice_picture.h"
#include "ui/views/tools/crop_tool.h"
#include "ui/views/tools/crosshair_tool.h"
#include "ui/views/tools/window_tool.h"

namespace pellucid::ui {

namespace {

constexpr double smoothCutMs = 16.0;
constexpr int restMs = 150;

} // namespace

namespace {

QImage pictureOf(const volume::Volume &volume, const mpr::Plane &plane,
                 const mpr::ResliceOptions &options, const volume::ValueWindow &window,
                 const std::optional<classify::TissueClass> &tint,
                 const std::vector<SegmentTint> &segments) {
    QImage picture = slicePicture(mpr::reslice(volume, plane, options), window, tint);
    if (!segments.empty()) {
        picture = picture.convertToFormat(QImage::Format_RGB32);
        tintSegments(picture, plane, volume.lattice(), segments);
    }
    return picture;
}

} // namespace

MprView::MprView(Document &document, mpr::Orientation orientation, QWidget *parent)
    : VolumePane(document, PaneView::plane, parent), m_orientation(orientation) {
    auto crosshair = std::make_unique<CrosshairTool>(document, *this, orientation);
    m_crosshair = crosshair.get();
    m_tools.add(Tool::window, std::make_unique<WindowTool>(document));
    m_tools.add(Tool::crosshair, std::move(crosshair));
    m_tools.add(Tool::crop, std::make_unique<CropTool>(document, *this));
    m_tools.choose(Tool::window);
    setObjectName(QString("%1View").arg(colorRole(orientation)));
    setAccessibleName(planeTitle(orientation));
    setMinimumSize(120, 100);
    m_rest.setSingleShot(true);
    m_rest.setInterval(restMs);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        m_isResting = true;
        refresh();
    });
    document.whenever(Change::volume, this, [this] {
        const auto &volume = m_document.volume();
        const bool isSameBox = volume && m_lattice.fillsSameBox(volume->lattice());
        // A volume that replaces its own preview does not interrupt a drag.
        if (!isSameBox || !m_wasPreview)
            m_tools.cancel();
        m_wasPreview = m_document.isPreview();
        m_cutMs = 0.0;
        if (volume) {
            m_lattice = volume->lattice();
            if (!isSameBox) // a different phase keeps the view
                resetView();
        }
        refresh();
    });
    document.whenever(Change::displayWindow | Change::tint | Change::crosshair | Change::cut, this,
                      &MprView::refresh);
    document.whenever(Change::scene | Change::segments, this, &MprView::refreshTints);
    connect(&document.marking(), &RegionMarking::tintChanged, this, &MprView::refreshTints);
    document.whenever(Change::measurements | Change::selection | Change::scene, this,
                      qOverload<>(&QWidget::update));
}

void MprView::refresh() {
    m_imageValid = false;
    update();
}

void MprView::refreshTints() {
    auto tints = segmentTints(m_document);
    if (tints == m_tints)
        return;
    m_tints = std::move(tints);
    refresh();
}

// Images without positions are shown in the axial pane only.
bool MprView::showsPicture() const {
    return m_document.volume() &&
           (m_document.volume()->notes().placed || m_orientation == mpr::Orientation::axial);
}

glm::dvec3 MprView::scrollAxis() const {
    return m_document.cut().axes.scrollAxis(m_orientation);
}

mpr::ScrollRange MprView::scrollRange() const {
    return mpr::scrollRange(m_document.volume()->lattice(), scrollAxis());
}

mpr::Plane MprView::plane() const {
    mpr::Plane plane;
    plane.axes = m_document.cut().axes.of(m_orientation);
    const double ratio = devicePixelRatioF();
    plane.width = std::max(1, int(std::lround(width() * ratio)));
    plane.height = std::max(1, int(std::lround(height() * ratio)));
    if (!m_document.volume())
        return plane;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // Fits the lattice's bounding box for the standard orientation, so that turning a plane does
    // not change the scale.
    const mpr::Axes upright = mpr::standardAxes(m_orientation);
    double halfWidth = 0.0, halfHeight = 0.0;
    for (int d = 0; d < 3; ++d) {
        halfWidth += 0.5 * lattice.size()[d] * std::abs(glm::dot(lattice.step(d), upright.right));
        halfHeight += 0.5 * lattice.size()[d] * std::abs(glm::dot(lattice.step(d), upright.up));
    }
    plane.pixelMm =
        std::max(2.0 * halfWidth / plane.width, 2.0 * halfHeight / plane.height) / m_view.zoom;
    const glm::dvec3 axis = scrollAxis();
    const double depth = glm::dot(m_document.crosshair().mm - lattice.center().mm, axis);
    plane.center = {lattice.center().mm + depth * axis + m_view.panMm.x * plane.axes.right +
                    m_view.panMm.y * plane.axes.up};
    return plane;
}

// Half the slab, or half the distance to the next slice.
double MprView::reachMm() const {
    return std::max(0.5 * m_document.cut().options.slab.thicknessMm, 0.5 * scrollRange().stepMm);
}

ToolSurface MprView::surface() const {
    return {mapping(), rect(), overlayColors(colorRole(m_orientation))};
}

void MprView::updateImage() {
    m_imageValid = true;
    const volume::Volume &volume = *m_document.volume();
    mpr::Plane cut = plane();
    const bool isDraft = !m_isResting && m_cutMs > smoothCutMs && m_sinceCut.isValid() &&
                         m_sinceCut.elapsed() < restMs;
    if (isDraft) {
        cut.width = (cut.width + 1) / 2;
        cut.height = (cut.height + 1) / 2;
        cut.pixelMm *= 2.0;
        m_rest.start();
    }
    QElapsedTimer clock;
    clock.start();
    m_image = pictureOf(volume, cut, m_document.cut().options, m_document.displayWindow(),
                        m_document.tint(), m_tints);
    m_image.setDevicePixelRatio(isDraft ? 0.5 * devicePixelRatioF() : devicePixelRatioF());
    if (!isDraft)
        m_cutMs = double(clock.nsecsElapsed()) * 1e-6;
    m_isResting = false;
    m_sinceCut.restart();
}

void MprView::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    painter.fillRect(rect(), QColor(pictureBackground));
    const OverlayColors colors = overlayColors(colorRole(m_orientation));
    if (showsPicture()) {
        if (!m_imageValid)
            updateImage();
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(QPoint(0, 0), m_image);
        painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
        m_tools.paint(painter, surface(), Marks::shown, m_overlays);
        if (m_overlays.texts)
            paintPlaneTexts(painter, rect(), mapping(), m_document, m_orientation, TextsFor::pane);
    } else if (m_document.volume()) {
        painter.setPen(colors.muted);
        painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                         tr("Images only: not a volume"));
    } else {
        paintPlaneTexts(painter, rect(), mapping(), m_document, m_orientation, TextsFor::pane);
    }
    painter.fillRect(QRect(0, 0, width(), 3), colors.plane);
    if (hasFocus()) {
        QColor focus = colors.accent;
        focus.setAlpha(140);
        painter.setPen(QPen(focus, 1));
        painter.drawRect(rect().adjusted(0, 3, -1, -1));
    }
}

std::function<QImage()> MprView::pictureMaker(int scale) const {
    mpr::Plane cut = plane();
    cut.width *= scale;
    cut.height *= scale;
    cut.pixelMm /= scale;
    return [cut, volume = *m_document.volume(), options = m_document.cut().options,
            window = m_document.displayWindow(), tint = m_document.tint(), tints = m_tints] {
        return pictureOf(volume, cut, options, window, tint, tints)
            .convertToFormat(QImage::Format_RGB32);
    };
}

void MprView::paintOver(QPainter &painter, Names names, const QString &patient) const {
    m_tools.paint(painter, surface(), names == Names::shown ? Marks::plain : Marks::nameless, {});
    paintPlaneTexts(painter, rect(), mapping(), m_document, m_orientation, TextsFor::picture, names,
                    patient);
}

void MprView::resizeEvent(QResizeEvent *) {
    m_imageValid = false;
    emit resized();
}

void MprView::mouseMoveEvent(QMouseEvent *event) {
    VolumePane::mouseMoveEvent(event);
    if (showsPicture())
        showReadout(event->position());
}

void MprView::hover(const QMouseEvent &event) {
    if ((event.modifiers() & Qt::ShiftModifier) != 0)
        m_crosshair->moveTo(event.position().toPoint());
}

void MprView::showReadout(const QPointF &position) {
    emit readoutChanged(valueText(*m_document.volume(), mapping().patientAt(position),
                                  m_document.cut().options.interpolation));
}

void MprView::scroll(int steps) {
    if (!showsPicture())
        return;
    const glm::dvec3 axis = scrollAxis(), at = m_document.crosshair().mm;
    const double depth = glm::dot(at, axis);
    m_document.setCrosshair({at + (scrollRange().moved(depth, steps) - depth) * axis});
}

void MprView::scrollToEnd(bool last) {
    scroll(last ? 1000000 : -1000000);
}

bool MprView::isAtEnd() const {
    if (!showsPicture())
        return true;
    const mpr::ScrollRange range = scrollRange();
    return glm::dot(m_document.crosshair().mm, scrollAxis()) > range.highMm - 0.5 * range.stepMm;
}

void MprView::panBy(const QPoint &delta) {
    const double pixelsPerMm = mapping().pixelsPerMm();
    moveView({m_view.zoom, m_view.panMm + glm::dvec2(-delta.x(), delta.y()) / pixelsPerMm});
}

void MprView::zoomBy(double factor) {
    moveView({std::clamp(m_view.zoom * factor, 0.2, 40.0), m_view.panMm});
}

void MprView::moveView(const View &view) {
    const bool isNew = !(view == m_view);
    m_view = view;
    refresh();
    if (isNew)
        emit viewMoved();
}

void MprView::resetView() {
    moveView({});
}

// Both panes show a mm at the same size, and the crosshair at the same place.
void MprView::adoptScale(const MprView &other) {
    if (!showsPicture() || !other.showsPicture())
        return;
    const mpr::Plane theirs = other.plane(), own = plane();
    const auto offset = [](const mpr::Plane &plane, const Document &document) {
        const glm::dvec3 mm = document.crosshair().mm - plane.center.mm;
        return glm::dvec2(glm::dot(mm, plane.axes.right), glm::dot(mm, plane.axes.up));
    };
    // The two panes may be on screens of different density.
    const double wantedMm = theirs.pixelMm * other.devicePixelRatioF() / devicePixelRatioF();
    moveView({m_view.zoom * own.pixelMm / wantedMm,
              m_view.panMm + offset(own, m_document) - offset(theirs, other.m_document)});
}

// The warning mark has no room for text.
QString MprView::helpAt(const QPoint &at) const {
    const QRect mark = warningMarkRect(rect()).adjusted(0, -20, 0, 0);
    return m_overlays.texts && mark.contains(at) ? warnings() : QString();
}

void MprView::wheelEvent(QWheelEvent *event) {
    const int steps = event->angleDelta().y() > 0 ? 1 : event->angleDelta().y() < 0 ? -1 : 0;
    const bool isPainting = m_document.marking().tool() == RegionTool::paint;
    if (isPainting && (event->modifiers() & Qt::ShiftModifier) != 0) {
        RegionOptions options = m_document.marking().options();
        options.ballMm = std::clamp(options.ballMm * (steps > 0   ? 1.15
                                                      : steps < 0 ? 1.0 / 1.15
                                                                  : 1.0),
                                    classify::smallestBallMm, classify::largestBallMm);
        m_document.marking().setOptions(options);
        update();
    } else if ((event->modifiers() & Qt::ControlModifier) != 0)
        zoomBy(steps > 0 ? 1.15 : steps < 0 ? 1.0 / 1.15 : 1.0);
    else
        scroll(steps);
    event->accept();
}

void MprView::keyPressEvent(QKeyEvent *event) {
    const int steps = (event->modifiers() & Qt::ShiftModifier) != 0 ? 10 : 1;
    switch (event->key()) {
    case Qt::Key_Up:
    case Qt::Key_Right:
        scroll(steps);
        break;
    case Qt::Key_Down:
    case Qt::Key_Left:
        scroll(-steps);
        break;
    case Qt::Key_Home:
        scrollToEnd(false);
        break;
    case Qt::Key_End:
        scrollToEnd(true);
        break;
    case Qt::Key_R:
        resetView();
        break;
    default:
        VolumePane::keyPressEvent(event);
    }
}

void MprView::leaveEvent(QEvent *event) {
    VolumePane::leaveEvent(event);
    emit readoutChanged({});
}

} // namespace pellucid::ui
