// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/pane_area.h"

#include <algorithm>

namespace pellucid::ui {

namespace {
constexpr int gap = 2;
}

PaneArea::PaneArea(const std::array<QWidget *, 4> &panes, QWidget *parent)
    : QWidget(parent), m_panes(panes) {
    setObjectName("paneArea");
    for (QWidget *pane : m_panes)
        pane->setParent(this);
    setMinimumSize(330, 330); // two of them fit a small screen
}

void PaneArea::setArrangement(PaneLayout layout, QWidget *maximized) {
    if (layout == m_layout && maximized == m_maximized)
        return;
    m_layout = layout;
    m_maximized = maximized;
    arrange();
    emit arranged();
}

void PaneArea::setPaneLayout(PaneLayout layout) {
    setArrangement(layout, nullptr);
}

void PaneArea::toggleMaximized(QWidget *pane) {
    setArrangement(m_layout, m_maximized == pane ? nullptr : pane);
}

void PaneArea::arrangeAs(const PaneArea &other) {
    const auto at = std::find(other.m_panes.begin(), other.m_panes.end(), other.m_maximized);
    setArrangement(other.m_layout, at == other.m_panes.end()
                                       ? nullptr
                                       : m_panes[std::size_t(at - other.m_panes.begin())]);
}

void PaneArea::resizeEvent(QResizeEvent *) {
    arrange();
}

void PaneArea::arrange() {
    for (QWidget *pane : m_panes)
        pane->setVisible(m_maximized == nullptr || pane == m_maximized);
    const int w = width(), h = height();
    if (m_maximized != nullptr) {
        m_maximized->setGeometry(0, 0, w, h);
        return;
    }
    if (m_layout == PaneLayout::twoByTwo) {
        const int left = (w - gap) / 2, top = (h - gap) / 2;
        m_panes[0]->setGeometry(0, 0, left, top);
        m_panes[3]->setGeometry(left + gap, 0, w - left - gap, top);
        m_panes[1]->setGeometry(0, top + gap, left, h - top - gap);
        m_panes[2]->setGeometry(left + gap, top + gap, w - left - gap, h - top - gap);
        return;
    }
    // The planes in a column of squares as far as the width allows, the projection beside them.
    const int side = (h - 2 * gap) / 3;
    const int column = std::min(side, w * 2 / 5);
    for (int n = 0; n < 3; ++n)
        m_panes[std::size_t(n)]->setGeometry(0, n * (side + gap), column,
                                             n == 2 ? h - 2 * (side + gap) : side);
    m_panes[3]->setGeometry(column + gap, 0, w - column - gap, h);
}

} // namespace pellucid::ui
