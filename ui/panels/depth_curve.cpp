// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/depth_curve.h"

#include <algorithm>
#include <cmath>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include "ui/theme/theme.h"

namespace pellucid::ui {

using shading::largestCurveValue;

DepthCurve::DepthCurve(QWidget *parent) : QWidget(parent) {
    setObjectName("depthCurve");
    setAccessibleName(tr("Weight by depth, far to near"));
    setToolTip(tr("Weight by depth, from far (left) to near (right); drag the points"));
    setFocusPolicy(Qt::StrongFocus);
    setFixedHeight(52);
}

void DepthCurve::setCue(const shading::DepthCue &cue) {
    m_cue = cue;
    m_selected = std::clamp(m_selected, 0, int(cue.curve.size()) - 1);
    update();
}

QRectF DepthCurve::plot() const {
    return QRectF(rect()).adjusted(6, 5, -6, -5);
}

double DepthCurve::yOf(double value) const {
    return plot().bottom() - value / largestCurveValue * plot().height();
}

QPointF DepthCurve::handleAt(int index) const {
    const double share = double(index) / double(m_cue.curve.size() - 1);
    return {plot().left() + share * plot().width(), yOf(m_cue.curve[std::size_t(index)])};
}

int DepthCurve::nearest(const QPointF &point) const {
    const double share = (point.x() - plot().left()) / plot().width();
    const int last = int(m_cue.curve.size()) - 1;
    return std::clamp(int(std::lround(share * last)), 0, last);
}

void DepthCurve::paintEvent(QPaintEvent *) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(Theme::current().color("line"), 1.0));
    painter.setBrush(Theme::current().color("background"));
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4.0, 4.0);
    painter.drawLine(QPointF(plot().left(), yOf(1.0)), QPointF(plot().right(), yOf(1.0)));
    painter.setBrush(Qt::NoBrush);
    QPainterPath path;
    const int steps = std::max(2, int(plot().width()));
    for (int n = 0; n <= steps; ++n) {
        const double share = double(n) / steps;
        const QPointF at(plot().left() + share * plot().width(),
                         yOf(std::clamp(m_cue.at(2.0 * share - 1.0), -0.1, 2.1)));
        n == 0 ? path.moveTo(at) : path.lineTo(at);
    }
    painter.setPen(QPen(Theme::current().color("curve"), 1.5));
    painter.drawPath(path);
    for (int n = 0; n < int(m_cue.curve.size()); ++n) {
        painter.setBrush(n == m_selected && hasFocus() ? Theme::current().color("curve")
                                                       : Theme::current().color("background"));
        painter.drawEllipse(handleAt(n), 3.5, 3.5);
    }
}

void DepthCurve::mousePressEvent(QMouseEvent *event) {
    m_drag = nextDragId();
    m_selected = nearest(event->position());
    update();
}

void DepthCurve::mouseMoveEvent(QMouseEvent *event) {
    if ((event->buttons() & Qt::LeftButton) == 0)
        return;
    const double value =
        (plot().bottom() - event->position().y()) / plot().height() * largestCurveValue;
    // Drags produce round values, as if typed.
    emit valueChanged(m_selected,
                      std::clamp(std::round(value * 20.0) / 20.0, 0.0, largestCurveValue), m_drag);
}

void DepthCurve::mouseDoubleClickEvent(QMouseEvent *event) {
    emit valueChanged(nearest(event->position()), 1.0, noDrag);
}

void DepthCurve::keyPressEvent(QKeyEvent *event) {
    const int last = int(m_cue.curve.size()) - 1;
    if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
        m_selected = std::clamp(m_selected + (event->key() == Qt::Key_Left ? -1 : 1), 0, last);
        update();
    } else if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down) {
        const double step = event->key() == Qt::Key_Up ? 0.05 : -0.05;
        emit valueChanged(
            m_selected,
            std::clamp(m_cue.curve[std::size_t(m_selected)] + step, 0.0, largestCurveValue), 0);
    } else {
        QWidget::keyPressEvent(event);
    }
}

} // namespace pellucid::ui
