// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/commands.h"
#include "ui/views/pane_mapping.h"

class QPainter;

namespace pellucid::ui {

struct OverlayColors;

/// Draws measurements on one pane and lets the hand make and change them: a drag makes a distance
/// or a region, a drag and a click an angle; corners and ends can be dragged, lines move the whole.
/// Every drag is one command.
class MeasureTool {
public:
    /// `isProjection`: shows and makes only distances in the plane of the picture.
    MeasureTool(Document &document, bool isProjection);

    struct Pane {
        PaneMapping mapping;
        /// Of points that are shown as in the plane, on either side of it.
        double reachMm = 0.0;
    };
    /// Whether it takes the mouse: over something drawn, or to make something of the kind.
    bool press(const Pane &pane, const QPointF &at, std::optional<measure::Kind> kind);
    void move(const Pane &pane, const QPointF &at);
    void release(const Pane &pane, const QPointF &at);
    /// Something is being made or dragged: moves are for it.
    bool isBusy() const { return m_grip != Grip::none; }
    /// What is half made goes, what is dragged stays where it is.
    void cancel();
    /// Something drawn is there that can be dragged.
    bool isOver(const Pane &pane, const QPointF &at) const;

    /// `plain`: nothing of what the hand takes hold of.
    enum class Marks { withSelection, plain };
    void paint(QPainter &painter, const Pane &pane, const OverlayColors &colors, Marks marks) const;

private:
    enum class Grip { none, making, thirdPoint, point, whole };
    struct Hit {
        int index;
        int point; ///< -1: the whole
    };
    bool isShown(const measure::Measurement &measurement, const Pane &pane) const;
    std::optional<Hit> hitAt(const Pane &pane, const QPointF &at) const;
    void finish();
    void edit(const QString &text);
    void paintOne(QPainter &painter, const Pane &pane, const measure::Measurement &measurement,
                  const QColor &color, bool isSelected) const;

    Document &m_document;
    const bool m_isProjection;
    Grip m_grip = Grip::none;
    /// What is being made, or the one that is dragged as it is now.
    measure::Measurement m_current;
    /// The dragged one as the document has it.
    measure::Measurement m_written;
    int m_index = -1, m_point = -1;
    QPointF m_pressed;
    glm::dvec3 m_lastMm{0.0};
    DragId m_drag = 0;
};

} // namespace pellucid::ui
