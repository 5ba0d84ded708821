// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QList>
#include <QObject>

#include "ui/views/overlay.h"
#include "ui/views/viewer.h"

class QAction;
class QActionGroup;
class QKeySequence;
class QMenu;
class QMainWindow;

namespace pellucid::ui {

class GraphicsCard;

/// The View menu: standard views, the study beside, layouts of the panes, engine.
class ViewMenu : public QObject {
    Q_OBJECT
public:
    ViewMenu(QMenu &menu, QMainWindow &window, const Viewer &viewer, GraphicsCard &card);

    QList<QAction *> layouts() const;
    /// The views from the six sides, and the angles.
    const QList<QAction *> &standardViews() const { return m_views; }
    /// Adds an entry below the layouts that shows and hides a pane.
    void addPane(QAction &toggle, const QString &text, const char *name, const QKeySequence &key);
    /// Enables the entries for a study beside, which is linked at first.
    void setBeside(bool isThere);
    void setLinked(bool isLinked);
    bool showsBanner() const;
    /// Shows the annotations again if they are hidden.
    void showAnnotations();

signals:
    void comparisonRequested(bool isComparing);
    void linkRequested();
    void closeBesideRequested();
    void preparationRequested();
    void anglesRequested();
    void overlaysChanged(const pellucid::ui::Overlays &overlays);
    void bannerToggled(bool isShown);

private:
    QAction *add(const QString &text, const char *name, const QKeySequence &key,
                 const std::function<void()> &run);
    void addStandardViews();
    void addOverlays();
    void showOverlays();
    void addBeside();
    void addLayouts();

    QMenu &m_menu;
    Viewer m_viewer;
    QActionGroup *m_layouts;
    QList<QAction *> m_views;
    QAction *m_afterPanes = nullptr;
    QAction *m_link = nullptr, *m_closeBeside = nullptr;
    QAction *m_texts = nullptr, *m_crosshair = nullptr, *m_banner = nullptr;
};

} // namespace pellucid::ui
