// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QElapsedTimer>
#include <QWidget>

#include "core/classify/density_field.h"
#include "core/classify/transfer_function.h"
#include "ui/document/commands.h"

namespace pellucid::ui {

/// Edits a Bézier transfer function over its range of values: weights from 0 to 2, with the
/// histogram behind. The width has one segment for each control point; the segment under the mouse
/// is framed and can be dragged up and down. A line follows the mouse and shows the weight there.
/// The wheel narrows and widens the range about the mouse; a drag of the axis moves it.
/// *Source*: Cheng 2007, section 4.3.1.
class CurveEditor : public QWidget {
    Q_OBJECT
public:
    explicit CurveEditor(QWidget *parent = nullptr);

    void setFunction(const classify::TransferFunction &function);
    /// `window`: the values of all densities.
    void setWindow(const classify::FieldWindow &window, const QString &unit);
    /// Heights from 0 to 1 over the range of the function; empty for no histogram.
    void setHistogram(std::vector<double> heights);
    int selectedPoint() const { return m_selected; }
    void selectPoint(int index);
    /// The center of a control point's handle.
    QPointF handleAt(int index) const;

signals:
    void pointSelected(int index);
    /// `drag`: constant during one drag.
    void weightChanged(int index, double weight, pellucid::ui::DragId drag);
    /// A valid range of densities.
    void rangeChanged(double low, double high, pellucid::ui::DragId drag);

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void leaveEvent(QEvent *event) override;
    QSize sizeHint() const override { return {260, 150}; }
    QSize minimumSizeHint() const override { return {200, 120}; }

private:
    QRectF plot() const;
    int segmentAt(double x) const;
    double yOf(double weight) const;
    /// The value at a share of the range, and the other way round.
    double valueAt(double share) const;
    double shareOf(double value) const;
    bool isOnAxis(const QPointF &at) const;
    void offerRange(double low, double width);
    void paintAxes(QPainter &painter);
    void paintHistogram(QPainter &painter);

    classify::TransferFunction m_function;
    classify::FieldWindow m_window{0.0, 1.0};
    QString m_unit;
    std::vector<double> m_histogram;
    int m_hovered = -1, m_selected = 0;
    double m_mouseX = -1.0;
    bool m_dragging = false, m_isMovingRange = false;
    double m_lowAtPress = 0.0, m_dragFromX = 0.0;
    QElapsedTimer m_sinceWheel;
    DragId m_drag = noDrag;
    double m_dragFromY = 0.0, m_dragFromWeight = 0.0;
};

} // namespace pellucid::ui
