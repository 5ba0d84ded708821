// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/views/pane_area.h"

#include <algorithm>
#include <optional>

#include <QMouseEvent>
#include <QSettings>
#include <QSplitter>
#include <QVariant>

namespace pellucid::ui {

namespace {

constexpr int gap = 2;
constexpr int reach = 2; ///< pixels on each side of the gap that belong to its handle, too
constexpr std::size_t sagittal = 2, projection = 3;
constexpr std::array layouts{PaneLayout::onePlusThree, PaneLayout::twoByTwo};

QString keyOf(PaneLayout layout) {
    return layout == PaneLayout::twoByTwo ? "panes/twoByTwo" : "panes/onePlusThree";
}

// Columns and rows.
qsizetype countOf(PaneLayout layout) {
    return layout == PaneLayout::twoByTwo ? 2 + 2 : 2 + 3;
}

class PaneHandle : public QSplitterHandle {
public:
    PaneHandle(Qt::Orientation orientation, QSplitter *splitter, PaneArea &area)
        : QSplitterHandle(orientation, splitter), m_area(area) {
        // The splitter places and paints the contents: the margins overlap the panes.
        if (orientation == Qt::Horizontal)
            setContentsMargins(reach, 0, reach, 0);
        else
            setContentsMargins(0, reach, 0, reach);
        setToolTip(
            PaneArea::tr("Drag to resize the panes; double-click to restore the default sizes"));
    }

protected:
    // Qt's version reduces the margins of such a narrow handle.
    void resizeEvent(QResizeEvent *) override {}

    void mousePressEvent(QMouseEvent *event) override {
        QSplitterHandle::mousePressEvent(event);
        if (event->button() == Qt::LeftButton)
            m_grip = along(event->position().toPoint()) - reach;
    }

    // Qt's version counts the margin as part of the gap, so a drag would begin with a jump.
    void mouseMoveEvent(QMouseEvent *event) override {
        if (m_grip && event->buttons().testFlag(Qt::LeftButton))
            moveSplitter(along(splitter()->mapFromGlobal(event->globalPosition().toPoint())) -
                         *m_grip);
    }

    void mouseDoubleClickEvent(QMouseEvent *event) override {
        if (event->button() != Qt::LeftButton)
            return;
        m_grip.reset(); // moves before the release drag nothing
        m_area.restoreDefaultSizes();
    }

private:
    int along(const QPoint &point) const {
        return orientation() == Qt::Horizontal ? point.x() : point.y();
    }

    PaneArea &m_area;
    std::optional<int> m_grip; ///< where the gap was pressed, from its edge
};

class PaneSplitter : public QSplitter {
public:
    PaneSplitter(Qt::Orientation orientation, const char *name, PaneArea &area)
        : QSplitter(orientation, &area), m_area(area) {
        setObjectName(name);
        setProperty("role", "panes");
        setHandleWidth(gap);
        setChildrenCollapsible(false);
    }

protected:
    QSplitterHandle *createHandle() override { return new PaneHandle(orientation(), this, m_area); }

private:
    PaneArea &m_area;
};

} // namespace

PaneArea::PaneArea(const std::array<QWidget *, 4> &panes, QWidget *parent)
    : QWidget(parent), m_panes(panes),
      m_columns(new PaneSplitter(Qt::Horizontal, "paneColumns", *this)),
      m_left(new PaneSplitter(Qt::Vertical, "leftPanes", *this)),
      m_right(new PaneSplitter(Qt::Vertical, "rightPanes", *this)) {
    setObjectName("paneArea");
    setMinimumSize(330, 330); // two areas fit on a small screen
    for (std::size_t n = 0; n < projection; ++n)
        m_left->addWidget(m_panes[n]);
    m_right->addWidget(m_panes[projection]);
    m_columns->addWidget(m_left);
    m_columns->addWidget(m_right);
    for (const QSplitter *splitter : {m_columns, m_left, m_right})
        connect(splitter, &QSplitter::splitterMoved, this,
                [this, splitter] { takeDraggedSizes(*splitter); });
}

void PaneArea::setPaneLayout(PaneLayout layout) {
    Arrangement next = m_arrangement;
    next.layout = layout;
    next.maximized.reset();
    setArrangement(next);
}

void PaneArea::toggleMaximized(QWidget *pane) {
    const auto n = std::size_t(std::find(m_panes.begin(), m_panes.end(), pane) - m_panes.begin());
    Arrangement next = m_arrangement;
    if (next.maximized == n)
        next.maximized.reset();
    else
        next.maximized = n;
    setArrangement(next);
}

void PaneArea::showAlone(QWidget *pane) {
    if (pane == nullptr && !m_isAlone)
        return;
    Arrangement next = m_arrangement;
    next.maximized.reset();
    if (pane != nullptr)
        next.maximized =
            std::size_t(std::find(m_panes.begin(), m_panes.end(), pane) - m_panes.begin());
    setArrangement(next);
    m_isAlone = pane != nullptr;
}

void PaneArea::arrangeAs(const PaneArea &other) {
    setArrangement(other.m_arrangement);
}

void PaneArea::restoreDefaultSizes() {
    Arrangement next = m_arrangement;
    next.sizes[std::size_t(next.layout)].clear();
    setArrangement(next);
}

void PaneArea::saveSizes(QSettings &settings) const {
    for (const PaneLayout layout : layouts) {
        const QList<int> &sizes = m_arrangement.sizes[std::size_t(layout)];
        if (sizes.isEmpty())
            settings.remove(keyOf(layout));
        else
            settings.setValue(keyOf(layout), QVariantList(sizes.begin(), sizes.end()));
    }
}

void PaneArea::restoreSizes(const QSettings &settings) {
    Arrangement next = m_arrangement;
    for (const PaneLayout layout : layouts) {
        QList<int> sizes;
        for (const QVariant &size : settings.value(keyOf(layout)).toList())
            sizes << size.toInt(); // 0: not a number
        const bool isValid = sizes.size() == countOf(layout) &&
                             std::all_of(sizes.begin(), sizes.end(), [](int size) {
                                 return size > 0 && size < QWIDGETSIZE_MAX;
                             });
        next.sizes[std::size_t(layout)] = isValid ? sizes : QList<int>();
    }
    setArrangement(next);
}

void PaneArea::resizeEvent(QResizeEvent *) {
    m_columns->setGeometry(rect());
    applySizes();
}

void PaneArea::setArrangement(const Arrangement &arrangement) {
    if (arrangement == m_arrangement)
        return;
    if (arrangement.maximized != m_arrangement.maximized)
        m_isAlone = false;
    const bool isResizedOnly = arrangement.layout == m_arrangement.layout &&
                               arrangement.maximized == m_arrangement.maximized;
    m_arrangement = arrangement;
    if (!isResizedOnly)
        placePanes();
    applySizes();
    emit arranged();
}

// The layouts differ in the column of the sagittal pane.
void PaneArea::placePanes() {
    QWidget *const moved = m_panes[sagittal];
    QSplitter *const column = m_arrangement.layout == PaneLayout::twoByTwo ? m_right : m_left;
    const bool hadFocus = moved->hasFocus(); // a change of parents takes it away
    if (moved->parentWidget() != column)
        column->addWidget(moved);
    const auto &maximized = m_arrangement.maximized;
    for (std::size_t n = 0; n < m_panes.size(); ++n)
        m_panes[n]->setVisible(!maximized || n == *maximized);
    for (QSplitter *parent : {m_left, m_right})
        parent->setVisible(!maximized || m_panes[*maximized]->parentWidget() == parent);
    // Without this, hidden panes would keep their space until the next event.
    for (QSplitter *splitter : {m_left, m_right, m_columns})
        splitter->refresh();
    if (hadFocus)
        moved->setFocus();
}

void PaneArea::applySizes() {
    QList<int> sizes = m_arrangement.sizes[std::size_t(m_arrangement.layout)];
    if (sizes.isEmpty())
        sizes = defaultSizes();
    m_columns->setSizes(sizes.first(2));
    m_left->setSizes(sizes.sliced(2));
    m_right->setSizes(sizes.sliced(2));
    // Keeps the rows aligned if the projection has a larger minimum height than the plane beside
    // it.
    if (m_arrangement.layout == PaneLayout::twoByTwo)
        m_left->setSizes(m_right->sizes());
}

QList<int> PaneArea::defaultSizes() const {
    const int w = width() - gap;
    if (m_arrangement.layout == PaneLayout::twoByTwo) {
        const int h = height() - gap;
        return {w / 2, w - w / 2, h / 2, h - h / 2};
    }
    // The planes in a column of squares as far as the width allows, the projection beside them.
    const int h = height() - 2 * gap;
    const int side = h / 3;
    const int column = std::min(side, width() * 2 / 5);
    return {column, w - column, side, side, h - 2 * side};
}

void PaneArea::takeDraggedSizes(const QSplitter &dragged) {
    const QSplitter &rows = &dragged == m_right ? *m_right : *m_left;
    Arrangement next = m_arrangement;
    next.sizes[std::size_t(next.layout)] = m_columns->sizes() + rows.sizes();
    if (next == m_arrangement) // the other column may not follow any further
        applySizes();
    else
        setArrangement(next);
}

} // namespace pellucid::ui
