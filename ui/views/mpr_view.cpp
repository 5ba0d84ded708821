// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/mpr_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <glm/geometric.hpp>

#include "core/mpr/reslice.h"
#include "core/render/camera.h"
#include "ui/document.h"
#include "ui/overlay.h"
#include "ui/theme.h"

namespace pellucid::ui {

namespace {

QString titleOf(mpr::Orientation o) {
    switch (o) {
    case mpr::Orientation::axial:
        return MprView::tr("Axial");
    case mpr::Orientation::coronal:
        return MprView::tr("Coronal");
    case mpr::Orientation::sagittal:
        break;
    }
    return MprView::tr("Sagittal");
}

const char *roleOf(mpr::Orientation o) {
    switch (o) {
    case mpr::Orientation::axial:
        return "axial";
    case mpr::Orientation::coronal:
        return "coronal";
    case mpr::Orientation::sagittal:
        break;
    }
    return "sagittal";
}

// "S 142.5": the side that the coordinate points to, and its size.
QString coordinateText(const glm::dvec3 &axis, double mm) {
    const std::string side = render::patientLetters(mm < 0.0 ? -axis : axis);
    return QString("%1 %2").arg(QString::fromStdString(side)).arg(std::abs(mm), 0, 'f', 1);
}

constexpr std::array<mpr::Orientation, 3> allOrientations{
    mpr::Orientation::axial, mpr::Orientation::coronal, mpr::Orientation::sagittal};

// A grey with as much of a class's color as the value belongs to it.
QRgb tinted(uchar grey, const classify::TissueClass &tint, double value) {
    constexpr double strength = 0.6;
    const double share = strength * tint.membership(value);
    const auto mix = [&](double part) {
        return int(std::lround((1.0 - share) * grey + share * 255.0 * part));
    };
    return qRgb(mix(tint.color.red), mix(tint.color.green), mix(tint.color.blue));
}

} // namespace

MprView::MprView(Document &document, mpr::Orientation orientation, QWidget *parent)
    : QWidget(parent), m_document(document), m_orientation(orientation) {
    setObjectName(QString("%1View").arg(roleOf(orientation)));
    setAccessibleName(titleOf(orientation));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setMinimumSize(120, 100);
    setCursor(Qt::ArrowCursor);
    const auto refresh = [this] {
        m_imageValid = false;
        update();
    };
    connect(&document, &Document::volumeChanged, this, [this, refresh] {
        if (!m_document.isPreview())
            resetView();
        refresh();
    });
    connect(&document, &Document::displayWindowChanged, this, refresh);
    connect(&document, &Document::tintChanged, this, refresh);
    connect(&document, &Document::crosshairChanged, this, refresh);
}

void MprView::setTool(Tool tool) {
    m_tool = tool;
    setCursor(tool == Tool::pan         ? Qt::OpenHandCursor
              : tool == Tool::zoom      ? Qt::SizeVerCursor
              : tool == Tool::crosshair ? Qt::CrossCursor
                                        : Qt::ArrowCursor);
}

mpr::Plane MprView::plane() const {
    mpr::Plane plane;
    mpr::setAxes(plane, m_orientation);
    const double ratio = devicePixelRatioF();
    plane.width = std::max(1, int(std::lround(width() * ratio)));
    plane.height = std::max(1, int(std::lround(height() * ratio)));
    if (!m_document.volume())
        return plane;
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // Fits the box around the lattice, as this plane sees it.
    double halfWidth = 1.0, halfHeight = 1.0;
    const glm::dvec3 n(lattice.size().i, lattice.size().j, lattice.size().k);
    halfWidth = halfHeight = 0.0;
    for (int d = 0; d < 3; ++d) {
        halfWidth += 0.5 * n[d] * std::abs(glm::dot(lattice.step(d), plane.right));
        halfHeight += 0.5 * n[d] * std::abs(glm::dot(lattice.step(d), plane.up));
    }
    plane.pixelMm =
        std::max(2.0 * halfWidth / plane.width, 2.0 * halfHeight / plane.height) / m_zoom;
    const glm::dvec3 axis = mpr::scrollAxis(m_orientation);
    const double depth = glm::dot(m_document.crosshair().mm - lattice.center().mm, axis);
    plane.center = {lattice.center().mm + depth * axis + m_panMm.x * plane.right +
                    m_panMm.y * plane.up};
    return plane;
}

volume::PatientPoint MprView::patientAt(const QPointF &position) const {
    const double ratio = devicePixelRatioF();
    return plane().at(position.x() * ratio - 0.5, position.y() * ratio - 0.5);
}

QPointF MprView::widgetPosition(const mpr::Plane &plane, volume::PatientPoint point) const {
    const glm::dvec2 pixel = plane.pixel(point);
    return QPointF(pixel.x + 0.5, pixel.y + 0.5) / devicePixelRatioF();
}

void MprView::updateImage() {
    m_imageValid = true;
    const volume::Volume &volume = *m_document.volume();
    const mpr::SliceImage slice = mpr::reslice(volume, plane());
    const auto &tint = m_document.tint();
    m_image =
        QImage(slice.width, slice.height, tint ? QImage::Format_RGB32 : QImage::Format_Grayscale8);
    const volume::ValueWindow &window = m_document.displayWindow();
    const auto low = float(window.center - 0.5 * window.width), scale = float(255.0 / window.width);
    const bool inverted = volume.notes().darkIsHigh;
    for (int r = 0; r < slice.height; ++r) {
        uchar *out = m_image.scanLine(r);
        auto *const pixels = reinterpret_cast<QRgb *>(out);
        const float *in = slice.values.data() + std::size_t(r) * slice.width;
        for (int c = 0; c < slice.width; ++c) {
            // Outside the volume is black, inverted or not.
            const bool isOutside = std::isnan(in[c]);
            const float bright = std::clamp((in[c] - low) * scale, 0.0F, 255.0F);
            const auto grey = uchar(isOutside ? 0.0F : inverted ? 255.0F - bright : bright);
            if (tint)
                pixels[c] = isOutside ? qRgb(0, 0, 0) : tinted(grey, *tint, double(in[c]));
            else
                out[c] = grey;
        }
    }
    m_image.setDevicePixelRatio(devicePixelRatioF());
}

void MprView::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    painter.fillRect(rect(), QColor(pictureBackground));
    const mpr::Plane shown = plane();
    if (m_document.volume()) {
        // Images without positions have one way to be seen.
        if (!m_document.volume()->notes().placed && m_orientation != mpr::Orientation::axial) {
            painter.setPen(overlayColors(roleOf(m_orientation)).muted);
            painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                             tr("Images only: no volume to cut"));
        } else {
            if (!m_imageValid)
                updateImage();
            painter.drawImage(QPoint(0, 0), m_image);
            paintCrosshair(painter, shown);
            paintTexts(painter, shown);
        }
    } else {
        paintTexts(painter, shown);
    }
    painter.fillRect(QRect(0, 0, width(), 3), overlayColors(roleOf(m_orientation)).plane);
    if (hasFocus()) {
        QColor focus = overlayColors(roleOf(m_orientation)).accent;
        focus.setAlpha(140);
        painter.setPen(QPen(focus, 1));
        painter.drawRect(rect().adjusted(0, 3, -1, -1));
    }
}

void MprView::paintCrosshair(QPainter &painter, const mpr::Plane &shown) {
    const QPointF at = widgetPosition(shown, m_document.crosshair());
    for (const mpr::Orientation other : allOrientations) {
        if (other == m_orientation)
            continue;
        // The other plane cuts this one along a line on which its own axis does not change.
        const glm::dvec3 axis = mpr::scrollAxis(other);
        QColor color = overlayColors(roleOf(other)).plane;
        color.setAlpha(170);
        painter.setPen(QPen(color, 1));
        if (std::abs(glm::dot(axis, shown.right)) > 0.5)
            painter.drawLine(QPointF(std::floor(at.x()) + 0.5, 3),
                             QPointF(std::floor(at.x()) + 0.5, height()));
        else
            painter.drawLine(QPointF(0, std::floor(at.y()) + 0.5),
                             QPointF(width(), std::floor(at.y()) + 0.5));
    }
}

void MprView::paintTexts(QPainter &painter, const mpr::Plane &shown) {
    const OverlayColors colors = overlayColors(roleOf(m_orientation));
    QFont bold = painter.font();
    bold.setBold(true);
    painter.save();
    painter.setFont(bold);
    drawText(painter, rect().adjusted(8, 8, -8, -8), Qt::AlignLeft | Qt::AlignTop,
             titleOf(m_orientation), colors.plane);
    painter.restore();
    if (!m_document.volume())
        return;
    const glm::dvec3 axis = mpr::scrollAxis(m_orientation);
    const bool placed = m_document.volume()->notes().placed;
    const QString position =
        placed
            ? coordinateText(axis, glm::dot(m_document.crosshair().mm, axis)) + " mm"
            : tr("image %1")
                  .arg(1 + int(std::lround(
                               m_document.volume()->lattice().voxel(m_document.crosshair()).v.z)));
    drawText(painter, rect().adjusted(8, 8, -8, -8), Qt::AlignRight | Qt::AlignTop, position,
             colors.text);
    if (placed)
        drawOrientationLetters(painter, rect(), shown.right, shown.up, colors);
    drawScaleBar(painter, QPoint(10, height() - 10), 1.0 / (shown.pixelMm * devicePixelRatioF()),
                 std::min(110, width() / 3), colors);
    const auto &warnings = m_document.volume()->notes().warnings;
    if (!warnings.empty())
        drawText(painter, rect().adjusted(8, 8, -8, -24), Qt::AlignRight | Qt::AlignBottom,
                 painter.fontMetrics().elidedText(QString::fromStdString(warnings.front()),
                                                  Qt::ElideRight, width() / 2),
                 colors.warning);
    if (m_document.volume()->notes().lossy)
        drawText(painter, rect().adjusted(8, 8, -8, -8), Qt::AlignRight | Qt::AlignBottom,
                 tr("lossy"), colors.warning);
}

void MprView::resizeEvent(QResizeEvent *) {
    m_imageValid = false;
}

void MprView::mousePressEvent(QMouseEvent *event) {
    setFocus();
    if (!m_document.volume())
        return;
    m_last = event->position().toPoint();
    m_drag = nextDragId();
    m_dragging = true;
    if (event->button() == Qt::MiddleButton)
        m_dragTool = Tool::pan;
    else if (event->button() == Qt::LeftButton)
        m_dragTool = m_tool;
    else
        m_dragging = false;
    if (m_dragging && m_dragTool == Tool::crosshair)
        moveCrosshair(m_last);
}

void MprView::mouseMoveEvent(QMouseEvent *event) {
    const QPoint position = event->position().toPoint();
    if (!m_document.volume())
        return;
    if (m_dragging)
        drag(position - m_last, position);
    else if ((event->modifiers() & Qt::ShiftModifier) != 0)
        moveCrosshair(position);
    m_last = position;
    const volume::PatientPoint at = patientAt(event->position());
    const float value = mpr::valueAt(*m_document.volume(), at);
    if (std::isnan(value)) {
        emit readoutChanged({});
        return;
    }
    const bool hounsfield = m_document.volume()->unit() == volume::ValueUnit::hounsfield;
    QString text =
        m_document.volume()->notes().placed
            ? QString("%1  %2  %3 mm   ")
                  .arg(coordinateText({1, 0, 0}, at.mm.x), coordinateText({0, 1, 0}, at.mm.y),
                       coordinateText({0, 0, 1}, at.mm.z))
            : QString();
    text +=
        QString::number(double(value), 'f', hounsfield || !m_document.volume()->isFloat() ? 0 : 3) +
        (hounsfield ? " HU" : "");
    emit readoutChanged(text);
}

void MprView::mouseReleaseEvent(QMouseEvent *) {
    m_dragging = false;
}

void MprView::mouseDoubleClickEvent(QMouseEvent *event) {
    if (event->button() == Qt::LeftButton)
        emit maximizeRequested(this);
}

void MprView::drag(const QPoint &delta, const QPoint &to) {
    switch (m_dragTool) {
    case Tool::window:
        windowBy(delta);
        break;
    case Tool::crosshair:
        moveCrosshair(to);
        break;
    case Tool::zoom:
        zoomBy(std::exp(-0.008 * delta.y()));
        break;
    case Tool::pan: {
        const double mm = plane().pixelMm * devicePixelRatioF();
        m_panMm += glm::dvec2(-delta.x() * mm, delta.y() * mm);
        m_imageValid = false;
        update();
        break;
    }
    }
}

void MprView::windowBy(const QPoint &delta) {
    // A pane's width of dragging covers the window itself once over, so that narrow and wide
    // windows are equally easy to set.
    volume::ValueWindow window = m_document.displayWindow();
    const double perPixel = std::max(window.width, 1e-6) / 250.0;
    window.width =
        std::max(window.width + delta.x() * perPixel, 1e-3 * std::max(1.0, std::abs(window.width)));
    window.center -= delta.y() * perPixel;
    window.name.clear();
    m_document.undoStack()->push(new EditDisplayWindow(m_document, window, m_drag));
}

void MprView::moveCrosshair(const QPoint &to) {
    const volume::Lattice &lattice = m_document.volume()->lattice();
    // Stays within the volume, where every pane has something to show.
    glm::dvec3 v = lattice.voxel(patientAt(to)).v;
    v = glm::clamp(v, glm::dvec3(0.0),
                   glm::dvec3(lattice.size().i - 1, lattice.size().j - 1, lattice.size().k - 1));
    m_document.setCrosshair(lattice.patient(volume::VoxelPoint{v}));
}

void MprView::scroll(int steps) {
    if (!m_document.volume())
        return;
    const mpr::ScrollRange range = mpr::scrollRange(m_document.volume()->lattice(), m_orientation);
    const glm::dvec3 axis = mpr::scrollAxis(m_orientation);
    const glm::dvec3 at = m_document.crosshair().mm;
    const double depth = glm::dot(at, axis);
    const double wanted = std::clamp(depth + steps * range.stepMm, range.lowMm, range.highMm);
    m_document.setCrosshair({at + (wanted - depth) * axis});
}

void MprView::scrollToEnd(bool last) {
    scroll(last ? 1000000 : -1000000);
}

void MprView::zoomBy(double factor) {
    m_zoom = std::clamp(m_zoom * factor, 0.2, 40.0);
    m_imageValid = false;
    update();
}

void MprView::resetView() {
    m_zoom = 1.0;
    m_panMm = {0.0, 0.0};
    m_imageValid = false;
    update();
}

void MprView::wheelEvent(QWheelEvent *event) {
    const int steps = event->angleDelta().y() > 0 ? 1 : event->angleDelta().y() < 0 ? -1 : 0;
    if ((event->modifiers() & Qt::ControlModifier) != 0)
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
        QWidget::keyPressEvent(event);
    }
}

void MprView::leaveEvent(QEvent *) {
    emit readoutChanged({});
}

} // namespace pellucid::ui
