// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include <QWidget>

#include "ui/views/overlay.h"
#include "ui/views/tools/pane_tools.h"

namespace pellucid::ui {

/// A pane that shows the open volume: it gives mouse and keys to its tools, opens its menu with the
/// right button, and is maximized by a double-click.
class VolumePane : public QWidget, public ToolPane {
    Q_OBJECT
public:
    void setTool(Tool tool);
    virtual void setOverlays(const Overlays &overlays);

signals:
    /// `measurement`: the one under the mouse, or -1.
    void menuRequested(QWidget *pane, const QPoint &globalAt, int measurement);
    void maximizeRequested(QWidget *pane);

protected:
    VolumePane(Document &document, PaneView view, QWidget *parent);

    /// Whether a picture is shown that the tools act on.
    virtual bool showsPicture() const = 0;
    /// Draws the marks of the tools again.
    virtual void updateMarks() { update(); }
    /// What a click does on something beside the picture; none elsewhere.
    virtual std::function<void()> controlAt(const QPointF & /*at*/) { return {}; }
    /// The tooltip at a position; empty: none.
    virtual QString helpAt(const QPoint &at) const = 0;
    /// The warnings of the volume, a line each.
    QString warnings() const;
    /// The mouse moves, and no tool uses it.
    virtual void hover(const QMouseEvent & /*event*/) {}

    void mousePressEvent(QMouseEvent *event) override;
    void mouseMoveEvent(QMouseEvent *event) override;
    void mouseReleaseEvent(QMouseEvent *event) override;
    void mouseDoubleClickEvent(QMouseEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void leaveEvent(QEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    bool event(QEvent *event) override;

    QSize paneSize() const override { return size(); }
    void askForText(const QPointF &at, const QString &text,
                    const std::function<void(const QString &)> &take) override;

    Document &m_document;
    PaneTools m_tools;
    Overlays m_overlays;

private:
    void showCursor(const QPointF &at);

    std::optional<QPointF> m_menuPress; ///< of the right button
};

} // namespace pellucid::ui
