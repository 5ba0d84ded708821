// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/settings/preferences.h"

class QComboBox;
class QMainWindow;
class QToolBar;

namespace pellucid::ui {

class ActionTable;

/// The tool bar of a window: opening, tools, views, layouts, export, and the window box of the
/// planes.
struct ToolBar {
    QToolBar *bar;
    QComboBox *windows; ///< empty
};
ToolBar makeToolBar(QMainWindow &window, ActionTable &actions);
void setToolBarStyle(QToolBar &bar, ToolBarStyle style);

} // namespace pellucid::ui
