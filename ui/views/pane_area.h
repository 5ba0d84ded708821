// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <QList>
#include <QWidget>

class QSettings;
class QSplitter;

namespace pellucid::ui {

/// How the four panes share the area: the planes in a column beside the projection, or two columns
/// of two panes.
enum class PaneLayout { onePlusThree, twoByTwo };

/// Arranges the three MPR panes and the projection. The user drags the borders between them, and
/// any pane can fill the area alone.
class PaneArea : public QWidget {
    Q_OBJECT
public:
    /// The area takes ownership of the panes. *Shape*: axial, coronal, sagittal, projection.
    PaneArea(const std::array<QWidget *, 4> &panes, QWidget *parent = nullptr);

    PaneLayout paneLayout() const { return m_arrangement.layout; }
    void setPaneLayout(PaneLayout layout);
    /// Fills the area with a pane, or shows all panes again if that pane already fills it.
    void toggleMaximized(QWidget *pane);
    /// Shows one pane until the user shows all of them, or until this is called again; null: all of
    /// them, unless the user has maximized one.
    void showAlone(QWidget *pane);
    bool isMaximized() const { return m_arrangement.maximized.has_value(); }
    /// Takes over the layout, the sizes and the maximized pane of another area.
    void arrangeAs(const PaneArea &other);
    /// Discards the sizes that the user gave to the panes of the current layout.
    void restoreDefaultSizes();
    /// Writes the sizes that the user gave to the panes, layout by layout.
    void saveSizes(QSettings &settings) const;
    /// Applies what saveSizes() wrote. A layout without valid sizes keeps its default.
    void restoreSizes(const QSettings &settings);

signals:
    /// The layout, the sizes or the maximized pane changed.
    void arranged();

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    struct Arrangement {
        PaneLayout layout = PaneLayout::onePlusThree;
        std::optional<std::size_t> maximized; ///< index of the pane
        /// One list for each layout: the widths of the columns, then the heights of the rows;
        /// empty: the default. *Units*: any, only the ratios count.
        std::array<QList<int>, 2> sizes;
        bool operator==(const Arrangement &) const = default;
    };
    void setArrangement(const Arrangement &arrangement);
    void placePanes();
    void applySizes();
    QList<int> defaultSizes() const;
    void takeDraggedSizes(const QSplitter &dragged);

    std::array<QWidget *, 4> m_panes;
    QSplitter *m_columns, *m_left, *m_right;
    Arrangement m_arrangement;
    bool m_isAlone = false; ///< the maximized pane was not the user's choice
};

} // namespace pellucid::ui
