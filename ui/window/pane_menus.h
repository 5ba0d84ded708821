// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>

#include <QObject>
#include <QPoint>

#include "ui/views/viewer.h"

class QMainWindow;
class QMenu;
class QWidget;

namespace pellucid::ui {

class ToolsMenu;

/// The menus that a right click on a pane opens. They consist of the entries of the window's menus,
/// found by their names.
class PaneMenus : public QObject {
    Q_OBJECT
public:
    PaneMenus(QMainWindow &window, const Viewer &viewer, const ToolsMenu &tools);
    /// The panes of a study beside have a shorter menu: most entries act on the open study.
    void addBeside(const Viewer &viewer);

private:
    void open(const Viewer &viewer, QWidget *pane, const QPoint &globalAt, int measurement);
    void addMeasurement(QMenu &menu, Document &document, int measurement);
    void watch(const Viewer &viewer);
    void addPlane(QMenu &menu, QWidget *pane);
    void addProjection(QMenu &menu);
    void addNamed(QMenu &menu, std::initializer_list<const char *> actions);
    void addSubmenu(QMenu &menu, const char *name);

    QMainWindow &m_window;
    Viewer m_viewer;
    const ToolsMenu &m_tools;
};

} // namespace pellucid::ui
