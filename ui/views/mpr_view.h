// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <QWidget>

#include "core/mpr/plane.h"
#include "ui/views/segment_tints.h"
#include "ui/views/volume_pane.h"

namespace pellucid::ui {

class CrosshairTool;

/// A pane with one of the three planes of the open volume: scrolling, window, pan, zoom, crosshair,
/// turning, measurements, orientation letters, scale bar.
class MprView : public VolumePane {
    Q_OBJECT
public:
    MprView(Document &document, mpr::Orientation orientation, QWidget *parent = nullptr);

    mpr::Orientation orientation() const { return m_orientation; }
    /// The plane that is shown, in device pixels of this widget.
    mpr::Plane plane() const;
    PaneMapping mapping() const override { return {plane(), devicePixelRatioF()}; }
    /// Steps through the slices.
    void scroll(int steps);
    void scrollToEnd(bool last);
    /// Whether the last slice is shown.
    bool isAtEnd() const;
    void resetView();
    /// Returns a function that makes the current slice with `scale` times the pane's pixels on each
    /// side; it may run on any thread.
    std::function<QImage()> pictureMaker(int scale) const;
    /// Paints the annotations of an exported slice. *Units*: logical pixels.
    void paintOver(QPainter &painter, Names names, const QString &patient) const;

    /// The part of the plane that the pane shows.
    struct View {
        double zoom = 1.0; ///< 1: the volume fits
        glm::dvec2 panMm{0.0};
        bool operator==(const View &) const = default;
    };
    const View &view() const { return m_view; }
    void moveView(const View &view);
    /// Adopts the scale of a different pane of the same plane, with the crosshair at its place
    /// there.
    void adoptScale(const MprView &other);

signals:
    /// Zoomed or panned.
    void viewMoved();
    void resized();
    /// The position and value under the cursor; an empty text when there is none.
    void readoutChanged(const QString &text);

protected:
    void paintEvent(QPaintEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void leaveEvent(QEvent *event) override;

private:
    bool showsPicture() const override;
    QString helpAt(const QPoint &at) const override;
    void hover(const QMouseEvent &event) override;
    void refresh();
    /// Draws again if other segments are tinted.
    void refreshTints();
    void updateImage();
    ToolSurface surface() const;
    void showReadout(const QPointF &position);
    glm::dvec3 scrollAxis() const;
    mpr::ScrollRange scrollRange() const;
    double reachMm() const override;
    void panBy(const QPoint &delta) override;
    void zoomBy(double factor) override;

    const mpr::Orientation m_orientation;
    CrosshairTool *m_crosshair; ///< one of the tools
    View m_view;
    /// The lattice of the last volume, which may have been a preview.
    volume::Lattice m_lattice;
    bool m_wasPreview = false;
    std::vector<SegmentTint> m_tints;
    QImage m_image;
    bool m_imageValid = false;
    /// If a slice takes too long, it is drawn at half resolution during interaction.
    double m_cutMs = 0.0;
    QElapsedTimer m_sinceCut;
    QTimer m_rest;
    bool m_isResting = false;
};

} // namespace pellucid::ui
