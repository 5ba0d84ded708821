// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ui/widgets/action_table.h"
#include "ui/window/actions/scope.h"

class QToolBar;

namespace pellucid::ui {

/// The rows of the table of actions. What they act on must outlive the table.
std::vector<Command> fileCommands(const Scope &scope);
std::vector<Command> viewCommands(const Scope &scope);
std::vector<Command> lookCommands(const Scope &scope);
std::vector<Command> toolCommands(const Scope &scope);

/// The mouse tools, and the Tools menu.
std::vector<MenuEntry> toolEntries();
MenuEntry toolsMenu();

/// The views from the six sides, and the angles.
std::vector<MenuEntry> standardViews();

/// What the menus contain, in their order.
struct Menus {
    std::vector<MenuEntry> bar;
    std::vector<MenuEntry> plane, projection; ///< of a pane, between its tools and what all have
    std::vector<MenuEntry> tools;             ///< the mouse tools
};
Menus menus();

/// Adds slab and mouse tools to the tool bar. Similar tools share a button, which shows the one
/// that was chosen last.
void addToolButtons(QToolBar &bar, const ActionTable &actions);

/// Turns the view, and shows the name of the patient or not, as the user last chose.
void restoreView(ProjectionView &projection, StudyPair &pair);

} // namespace pellucid::ui
