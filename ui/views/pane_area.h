// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <QWidget>

namespace pellucid::ui {

/// How the four panes share the window.
enum class PaneLayout { onePlusThree, twoByTwo };

/// Arranges the three MPR panes and the projection; any of them can fill the area alone.
class PaneArea : public QWidget {
    Q_OBJECT
public:
    /// Panes in the order axial, coronal, sagittal, projection; they become children.
    PaneArea(const std::array<QWidget *, 4> &panes, QWidget *parent = nullptr);

    void setPaneLayout(PaneLayout layout);
    PaneLayout paneLayout() const { return m_layout; }
    /// Fills the area with a pane, or brings the others back if it does so already.
    void toggleMaximized(QWidget *pane);
    bool isMaximized() const { return m_maximized != nullptr; }
    /// In the layout of another one, the same pane alone.
    void arrangeAs(const PaneArea &other);

signals:
    /// Another layout, or a pane fills the area or does no more.
    void arranged();

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void setArrangement(PaneLayout layout, QWidget *maximized);
    void arrange();
    std::array<QWidget *, 4> m_panes;
    PaneLayout m_layout = PaneLayout::onePlusThree;
    QWidget *m_maximized = nullptr;
};

} // namespace pellucid::ui
