// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPoint>

#include "ui/views/viewer.h"

class QMenu;
class QWidget;

namespace pellucid::ui {

class ActionTable;

/// The menus that a right click on a pane opens. They consist of rows of the table of actions.
class PaneMenus : public QObject {
    Q_OBJECT
public:
    PaneMenus(const Viewer &viewer, ActionTable &actions, QObject *parent);
    /// The panes of a study beside have a shorter menu: most entries act on the open study.
    void addBeside(const Viewer &viewer);

private:
    void open(const Viewer &viewer, QWidget *pane, const QPoint &globalAt, int measurement);
    void addMeasurement(QMenu &menu, Document &document, int measurement);
    void watch(const Viewer &viewer);

    Viewer m_viewer;
    ActionTable &m_actions;
};

} // namespace pellucid::ui
