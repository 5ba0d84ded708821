// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/curve_editor.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>

#include "ui/language/number_text.h"
#include "ui/theme/theme.h"

namespace pellucid::ui {

namespace {

constexpr double maxWeight = classify::TransferFunction::largestWeight;
constexpr double keyStep = 0.05;
constexpr double handleRadius = 4.5;

// Tick marks at round values, two to five of them.
double tickStep(double range) {
    const double rough = range / 3.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= rough)
            return step * power;
    return 10.0 * power;
}

} // namespace

CurveEditor::CurveEditor(QWidget *parent) : QWidget(parent) {
    setObjectName("curveEditor");
    setAccessibleName(tr("Transfer function"));
    setToolTip(tr("Drag a segment up or down; double-click resets it to 1. The wheel zooms the "
                  "axis, a drag of the axis moves it, a double-click on it shows all values"));
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
}

void CurveEditor::setFunction(const classify::TransferFunction &function) {
    m_function = function;
    m_selected = std::clamp(m_selected, 0, int(function.weights.size()) - 1);
    if (m_hovered >= int(function.weights.size()))
        m_hovered = -1;
    update();
}

void CurveEditor::setWindow(const classify::FieldWindow &window, const QString &unit) {
    m_window = window;
    m_unit = unit;
    update();
}

void CurveEditor::setHistogram(std::vector<double> heights) {
    m_histogram = std::move(heights);
    update();
}

void CurveEditor::selectPoint(int index) {
    const int point = std::clamp(index, 0, int(m_function.weights.size()) - 1);
    if (point == m_selected)
        return;
    m_selected = point;
    emit pointSelected(point);
    update();
}

QRectF CurveEditor::plot() const {
    const int line = fontMetrics().height();
    return QRectF(rect()).adjusted(18, 4, -10, -line - 4);
}

int CurveEditor::segmentAt(double x) const {
    const QRectF area = plot();
    const int count = int(m_function.weights.size());
    return std::clamp(int((x - area.left()) / area.width() * count), 0, count - 1);
}

double CurveEditor::yOf(double weight) const {
    const QRectF area = plot();
    return area.bottom() - weight / maxWeight * area.height();
}

QPointF CurveEditor::handleAt(int index) const {
    const QRectF area = plot();
    const auto count = double(m_function.weights.size());
    return {area.left() + (index + 0.5) / count * area.width(),
            yOf(m_function.weights[std::size_t(index)])};
}

double CurveEditor::valueAt(double share) const {
    const double f = m_function.low + share * (m_function.high - m_function.low);
    return m_window.low + f * (m_window.high - m_window.low);
}

double CurveEditor::shareOf(double value) const {
    const double f = (value - m_window.low) / (m_window.high - m_window.low);
    return (f - m_function.low) / (m_function.high - m_function.low);
}

bool CurveEditor::isOnAxis(const QPointF &at) const {
    return at.y() > plot().bottom() + 2.0;
}

void CurveEditor::paintAxes(QPainter &painter) {
    const QRectF area = plot();
    painter.setPen(Theme::current().color("muted"));
    QFont small = font();
    small.setPointSizeF(0.85 * small.pointSizeF());
    painter.setFont(small);
    for (const double weight : {0.0, 1.0, 2.0})
        painter.drawText(QRectF(0, yOf(weight) - 8, area.left() - 4, 16),
                         Qt::AlignRight | Qt::AlignVCenter, QString::number(weight));
    const double low = valueAt(0.0), high = valueAt(1.0), range = high - low;
    if (!(range > 0.0))
        return;
    const double step = tickStep(range);
    for (double value = std::ceil(low / step) * step; value <= high + 1e-9 * range; value += step) {
        const double x = area.left() + shareOf(value) * area.width();
        painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3));
        const QRectF box(x - 34, area.bottom() + 3, 68, 16);
        painter.drawText(box.translated(std::min(0.0, width() - 2 - box.right()), 0.0),
                         Qt::AlignHCenter | Qt::AlignTop,
                         numberText(std::abs(value) < 1e-9 * range ? 0.0 : value));
    }
}

void CurveEditor::paintHistogram(QPainter &painter) {
    if (m_histogram.empty())
        return;
    const QRectF area = plot();
    QPainterPath path(area.bottomLeft());
    const auto count = double(m_histogram.size());
    for (std::size_t n = 0; n < m_histogram.size(); ++n)
        path.lineTo(area.left() + (double(n) + 0.5) / count * area.width(),
                    area.bottom() - m_histogram[n] * 0.9 * area.height());
    path.lineTo(area.bottomRight());
    path.closeSubpath();
    painter.fillPath(path, Theme::current().color("line"));
}

void CurveEditor::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF area = plot();
    painter.fillRect(area, Theme::current().color("background"));
    paintHistogram(painter);
    paintAxes(painter);
    const int count = int(m_function.weights.size());
    if (m_hovered >= 0) {
        const double width = area.width() / count;
        QColor fill = Theme::current().color("accent");
        painter.setPen(QPen(fill, 1.0));
        fill.setAlphaF(0.18F);
        painter.setBrush(fill);
        painter.drawRect(QRectF(area.left() + m_hovered * width, area.top(), width, area.height()));
    }
    QPainterPath curve;
    constexpr int steps = 128;
    for (int n = 0; n <= steps; ++n) {
        const double share = double(n) / steps;
        const double f = m_function.low + share * (m_function.high - m_function.low);
        const QPointF at(area.left() + share * area.width(), yOf(m_function.at(f)));
        n == 0 ? curve.moveTo(at) : curve.lineTo(at);
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Theme::current().color("curve"), 2.0));
    painter.drawPath(curve);
    for (int n = 0; n < count; ++n) {
        painter.setBrush(n == m_selected && hasFocus() ? Theme::current().color("curve")
                                                       : Theme::current().color("background"));
        painter.drawEllipse(handleAt(n), handleRadius, handleRadius);
    }
    if (m_mouseX < area.left() || m_mouseX > area.right())
        return;
    painter.setPen(QPen(Theme::current().color("error"), 1.0));
    painter.drawLine(QPointF(m_mouseX, area.top()), QPointF(m_mouseX, area.bottom()));
    const double share = (m_mouseX - area.left()) / area.width();
    const double f = m_function.low + share * (m_function.high - m_function.low);
    const double value = valueAt(share);
    painter.setPen(Theme::current().color("curve"));
    painter.drawText(area.adjusted(6, 2, 0, 0), Qt::AlignLeft | Qt::AlignTop,
                     tr("weight %1 at %2%3")
                         .arg(QString::number(m_function.at(f), 'f', 2), numberText(value),
                              m_unit.isEmpty() ? QString() : " " + m_unit));
}

void CurveEditor::mousePressEvent(QMouseEvent *event) {
    if (event->button() != Qt::LeftButton)
        return;
    if (isOnAxis(event->position())) {
        m_isMovingRange = true;
        m_drag = nextDragId();
        m_dragFromX = event->position().x();
        m_lowAtPress = m_function.low;
        setCursor(Qt::ClosedHandCursor);
        return;
    }
    const int segment = segmentAt(event->position().x());
    m_dragging = true;
    m_hovered = segment;
    m_drag = nextDragId();
    m_dragFromY = event->position().y();
    m_dragFromWeight = m_function.weights[std::size_t(segment)];
    selectPoint(segment);
    setCursor(Qt::SizeVerCursor);
    update();
}

void CurveEditor::mouseMoveEvent(QMouseEvent *event) {
    m_mouseX = event->position().x();
    if (m_isMovingRange) {
        const double width = m_function.high - m_function.low;
        const double by = (m_dragFromX - m_mouseX) / plot().width() * width;
        offerRange(m_lowAtPress + by, width);
        return;
    }
    if (!m_dragging) {
        m_hovered = plot().contains(event->position()) ? segmentAt(m_mouseX) : -1;
        update();
        return;
    }
    const double moved = (m_dragFromY - event->position().y()) / plot().height() * maxWeight;
    emit weightChanged(m_selected, std::clamp(m_dragFromWeight + moved, 0.0, maxWeight), m_drag);
    update();
}

void CurveEditor::mouseReleaseEvent(QMouseEvent *) {
    m_dragging = m_isMovingRange = false;
    unsetCursor();
}

void CurveEditor::offerRange(double low, double width) {
    const double wide = std::clamp(width, classify::TransferFunction::narrowestRange, 1.0);
    const double from = std::clamp(low, 0.0, 1.0 - wide);
    if (from != m_function.low || from + wide != m_function.high)
        emit rangeChanged(from, std::min(1.0, from + wide), m_drag);
}

// One turn of the wheel is one edit.
void CurveEditor::wheelEvent(QWheelEvent *event) {
    constexpr double factor = 1.25;
    constexpr qint64 pauseMs = 700;
    const int steps = event->angleDelta().y();
    event->accept();
    if (steps == 0)
        return;
    if (!m_sinceWheel.isValid() || m_sinceWheel.elapsed() > pauseMs)
        m_drag = nextDragId();
    m_sinceWheel.start();
    const QRectF area = plot();
    const double share = std::clamp((event->position().x() - area.left()) / area.width(), 0.0, 1.0);
    const double width = m_function.high - m_function.low,
                 wanted = std::clamp(steps > 0 ? width / factor : width * factor,
                                     classify::TransferFunction::narrowestRange, 1.0);
    offerRange(m_function.low + share * (width - wanted), wanted);
}

void CurveEditor::mouseDoubleClickEvent(QMouseEvent *event) {
    m_dragging = m_isMovingRange = false;
    if (isOnAxis(event->position())) {
        m_drag = nextDragId();
        offerRange(0.0, 1.0);
        return;
    }
    emit weightChanged(segmentAt(event->position().x()), 1.0, nextDragId());
}

void CurveEditor::keyPressEvent(QKeyEvent *event) {
    const double weight = m_function.weights[std::size_t(m_selected)];
    switch (event->key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
        selectPoint(m_selected + (event->key() == Qt::Key_Left ? -1 : 1));
        break;
    case Qt::Key_Up:
    case Qt::Key_Down:
        emit weightChanged(
            m_selected,
            std::clamp(weight + (event->key() == Qt::Key_Up ? keyStep : -keyStep), 0.0, maxWeight),
            nextDragId());
        break;
    default:
        QWidget::keyPressEvent(event);
    }
}

void CurveEditor::leaveEvent(QEvent *) {
    m_hovered = -1;
    m_mouseX = -1.0;
    update();
}

} // namespace pellucid::ui
