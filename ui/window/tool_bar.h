// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>

#include "ui/settings/preferences.h"

class QAction;
class QMainWindow;
class QMenu;

namespace pellucid::ui {

class Document;
class Theme;
class ToolsMenu;

/// What the tool bar takes from the menus, which are there before it.
struct ToolBarSources {
    ToolsMenu &tools;
    QList<QAction *> layouts;
    QMenu &windowMenu; ///< gets the windows that the bar's box offers
};

/// Adds the tool bar to a window: opening, tools, layouts, exporting, and the window of the planes.
void makeToolBar(QMainWindow &window, Document &document, const Theme &theme, ToolBarStyle style,
                 const ToolBarSources &sources);

} // namespace pellucid::ui
