// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>

#include "ui/settings/preferences.h"

class QAction;
class QMainWindow;
class QMenu;

namespace pellucid::ui {

class Document;
class ToolsMenu;
class WindowChooser;

/// What the tool bar takes from the menus, which must exist before it.
struct ToolBarSources {
    ToolsMenu &tools;
    QList<QAction *> layouts;
    QList<QAction *> views;
    QMenu &windowMenu; ///< filled with the entries of the tool bar's window box
};

/// Adds the tool bar to a window: opening, tools, layouts, export, and the window box of the
/// planes. Returns the chooser of that box.
WindowChooser *makeToolBar(QMainWindow &window, Document &document, ToolBarStyle style,
                           const ToolBarSources &sources);
/// What the buttons of the window's tool bar show from now on.
void setToolBarStyle(QMainWindow &window, ToolBarStyle style);

} // namespace pellucid::ui
