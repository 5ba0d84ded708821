// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Draws, creates and changes the measurements of one pane. A drag creates a distance or a region;
/// a drag and a click create an angle. Ends and corners can be dragged; dragging a line moves the
/// whole. Each drag is one edit.
class MeasureTool : public PaneTool {
public:
    /// The measurements that a pane shows and creates.
    enum class Figures {
        inPatient,
        inPicture ///< distances in the plane of a projection's picture
    };
    MeasureTool(Document &document, const ToolPane &pane, Figures figures);

    /// What a drag on an empty spot creates; none: only existing measurements can be dragged.
    void setKind(std::optional<measure::Kind> kind) { m_kind = kind; }

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    std::optional<Qt::CursorShape> gripCursor(const QPointF &at) const override;
    bool press(const QPointF &at) override;
    bool move(const MouseMove &mouse) override;
    void release(const QPointF &at) override;
    /// Also true between presses: the third point of an angle follows the mouse without a button.
    bool isBusy() const override { return m_grip != Grip::none; }
    void cancel() override { m_grip = Grip::none; }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    enum class Grip { none, making, thirdPoint, point, whole };
    struct Hit {
        int index;
        int point; ///< -1: the whole measurement
    };
    bool isShown(const measure::Measurement &measurement, const mpr::Plane &plane) const;
    std::optional<Hit> hitAt(const QPointF &at) const;
    void moveTo(const QPointF &at);
    void finish();
    void edit(const QString &text);

    Document &m_document;
    const ToolPane &m_pane;
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
