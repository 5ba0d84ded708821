// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMenu;
class QWidget;

namespace pellucid::ui {

/// Adds the manual and the About dialog.
void addHelpMenu(QMenu &menu, QWidget &window);

} // namespace pellucid::ui
