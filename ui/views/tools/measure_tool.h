// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/commands.h"
#include "ui/views/tools/pane_tool.h"
#include "ui/views/tools/tool_pane.h"

namespace pellucid::ui {

/// Draws measurements on one pane and lets the hand make and change them: a drag makes a distance
/// or a region, a drag and a click an angle; corners and ends can be dragged, lines move the whole.
/// Every drag is one command.
class MeasureTool : public PaneTool {
public:
    /// Which measurements a pane shows and makes.
    enum class Figures {
        inPatient,
        inPicture ///< distances in the plane of a projection's picture
    };
    MeasureTool(Document &document, const ToolPane &pane, Figures figures);

    /// What a drag makes where nothing is drawn; none: only what is drawn can be dragged.
    void setKind(std::optional<measure::Kind> kind) { m_kind = kind; }

    Qt::CursorShape cursor() const override { return Qt::CrossCursor; }
    std::optional<Qt::CursorShape> gripCursor(const QPointF &at) const override;
    bool press(const QPointF &at) override;
    bool move(const HandMove &hand) override;
    void release(const QPointF &at) override;
    /// It may be between two drags: the third point of an angle follows the hand without a button.
    bool isBusy() const override { return m_grip != Grip::none; }
    void cancel() override { m_grip = Grip::none; }
    void paint(QPainter &painter, const ToolSurface &surface, Marks marks) const override;

private:
    enum class Grip { none, making, thirdPoint, point, whole };
    struct Hit {
        int index;
        int point; ///< -1: the whole
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
    /// What is being made, or the one that is dragged as it is now.
    measure::Measurement m_current;
    /// The dragged one as the document has it.
    measure::Measurement m_written;
    int m_index = -1, m_point = -1;
    QPointF m_pressed;
    glm::dvec3 m_lastMm{0.0};
    DragId m_drag = noDrag;
};

} // namespace pellucid::ui
