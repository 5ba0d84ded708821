// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Draws, creates and changes the measurements and annotations of one pane. A drag creates a
/// distance, an arrow or a region; a drag and a click an angle; two drags a Cobb angle; clicks a
/// polyline, until a double-click or Enter; a click a text. Ends and corners can be dragged;
/// dragging a line moves the whole. Each drag is one edit.
class MeasureTool : public PaneTool {
public:
    /// The measurements that a pane shows and creates.
    enum class Figures {
        inPatient,
        inPicture ///< in the plane of a projection's picture
    };
    MeasureTool(Document &document, ToolPane &pane, Figures figures);

    /// What a drag on an empty spot creates; none: only existing measurements can be dragged.
    void setKind(std::optional<measure::Kind> kind) { m_kind = kind; }

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    std::optional<Qt::CursorShape> gripCursor(const QPointF &at) const override;
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    /// Ends a polyline, or edits the text at this position. Returns whether there was one.
    bool doublePress(const QPointF &at);
    /// Ends a polyline at its last corner. Returns false if there is none.
    bool finishPolyline();
    /// The measurement at this position, or -1.
    int at(const QPointF &at) const;
    /// Also true between presses: the next point of a figure follows the mouse without a button.
    bool isBusy() const override { return m_grip != Grip::none; }
    void cancel() override { m_grip = Grip::none; }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    enum class Grip {
        none,
        making,    ///< the last point follows the mouse with the button
        nextPoint, ///< the last point follows the mouse without a button
        nextLine,  ///< a Cobb angle has its first line
        point,
        whole
    };
    struct Hit {
        int index;
        int point; ///< -1: the whole measurement
    };
    bool isShown(const measure::Measurement &measurement, const mpr::Plane &plane) const;
    std::optional<Hit> hitAt(const QPointF &at) const;
    void begin(const QPointF &at);
    void moveTo(const QPointF &at);
    void endDrag(const QPointF &at);
    void finish();
    void askForText(const QPointF &at);
    void rename(int index, const QString &text);
    void edit(const QString &text);

    Document &m_document;
    ToolPane &m_pane;
    const Figures m_figures;
    std::optional<measure::Kind> m_kind;
    Grip m_grip = Grip::none;
    /// The measurement that is being created or dragged, in its current state.
    measure::Measurement m_current;
    /// The dragged measurement as stored in the document.
    measure::Measurement m_stored;
    int m_index = -1, m_point = -1;
    QPointF m_pressed;
    glm::dvec3 m_lastMm{0.0};
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
