// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QFontMetrics>
#include <QImage>
#include <QWidget>

#include "ui/views/overlay.h"
#include "ui/views/tools/pane_tool.h"

namespace pellucid::ui {

class Document;
class PaneTools;

/// The annotations over the projection: names, figures of the picture, letters, cube, scale,
/// measurements. The mouse goes through to the pane below. The canvas below may be an OpenGL
/// surface.
class ProjectionOverlay : public QWidget {
public:
    struct Texts {
        QString lookName, message;
        QString figures; ///< engine, time and error of the picture; empty while there is none
    };

    ProjectionOverlay(const Document &document, const PaneTools &tools, QWidget *parent);

    void setTexts(const Texts &texts);
    void setMapping(const PaneMapping &mapping);
    void setShowsCrosshair(bool isShown);
    void setOverlays(const Overlays &overlays);
    /// Covers the canvas with a picture; null: with none. `name`: of the look at its left.
    void setComparison(const QImage &picture, const QString &name);
    /// The side of the orientation cube at a position, see ui::cubeSideAt.
    std::optional<glm::dvec3> cubeSideAt(const QPointF &at) const;
    /// Whether a position is on the angles of the view, beside the cube.
    bool isOnAngles(const QPointF &at) const;
    /// Whether a position is on the figures of the picture.
    bool isOnFigures(const QPointF &at) const;
    /// Whether a position is on the mark of the warnings.
    bool isOnWarnings(const QPoint &at) const;
    /// Paints the annotations over any picture of the pane's size.
    void paint(QPainter &painter, const PaneMapping &mapping, Marks marks, Names names) const;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void paintPicture(QPainter &painter, const PaneMapping &mapping, Marks marks) const;
    OverlayColors colors() const;
    QPointF cubeCenter() const;
    QRect markArea() const;
    QRect anglesRect(const QFontMetrics &metrics, const QString &text) const;
    void paintCrosshair(QPainter &painter, const PaneMapping &mapping) const;

    const Document &m_document;
    const PaneTools &m_tools;
    Texts m_texts;
    QImage m_comparison;
    QString m_comparedName;
    bool m_showsCrosshair = false;
    Overlays m_overlays;
    PaneMapping m_mapping;
};

} // namespace pellucid::ui
