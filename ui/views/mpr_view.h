// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QWidget>

#include "core/mpr/plane.h"
#include "ui/commands.h"
#include "ui/tools.h"

namespace pellucid::ui {

class Document;

/// One orthogonal plane of the open volume: scroll, window, pan, zoom, crosshair, letters, scale.
class MprView : public QWidget {
    Q_OBJECT
public:
    MprView(Document &document, mpr::Orientation orientation, QWidget *parent = nullptr);

    void setTool(Tool tool);
    mpr::Orientation orientation() const { return m_orientation; }
    /// The plane that is shown, in device pixels of this widget.
    mpr::Plane plane() const;
    /// Steps through the slices.
    void scroll(int steps);
    void scrollToEnd(bool last);
    void resetView();

signals:
    void maximizeRequested(QWidget *pane);
    /// The position and value under the cursor; an empty text when there is none.
    void readoutChanged(const QString &text);

protected:
    void paintEvent(QPaintEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void leaveEvent(QEvent *event) override;

private:
    void updateImage();
    void paintCrosshair(QPainter &painter, const mpr::Plane &plane);
    void paintTexts(QPainter &painter, const mpr::Plane &plane);
    void drag(const QPoint &delta, const QPoint &to);
    void moveCrosshair(const QPoint &to);
    void windowBy(const QPoint &delta);
    void zoomBy(double factor);
    volume::PatientPoint patientAt(const QPointF &position) const;
    QPointF widgetPosition(const mpr::Plane &plane, volume::PatientPoint point) const;

    Document &m_document;
    const mpr::Orientation m_orientation;
    Tool m_tool = Tool::window;
    Tool m_dragTool = Tool::window;
    bool m_dragging = false;
    DragId m_drag = 0;
    QPoint m_last;
    double m_zoom = 1.0;
    glm::dvec2 m_panMm{0.0};
    QImage m_image;
    bool m_imageValid = false;
};

} // namespace pellucid::ui
