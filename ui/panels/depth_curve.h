// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/shading/shading.h"
#include "ui/document/commands.h"

namespace pellucid::ui {

/// Edits a depth cue as a curve from the far end (left) to the near end (right), with weights from
/// 0 to 2. Points are dragged up and down; a double-click resets one to 1.
class DepthCurve : public QWidget {
    Q_OBJECT
public:
    explicit DepthCurve(QWidget *parent = nullptr);

    void setCue(const shading::DepthCue &cue);
    /// The center of a point's handle.
    QPointF handleAt(int index) const;

signals:
    /// `drag`: constant during one drag.
    void valueChanged(int index, double value, pellucid::ui::DragId drag);

protected:
    void paintEvent(QPaintEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    QSize sizeHint() const override { return {150, 52}; }

private:
    QRectF plot() const;
    double yOf(double value) const;
    int nearest(const QPointF &point) const;

    shading::DepthCue m_cue;
    int m_selected = 0;
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
