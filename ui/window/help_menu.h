// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMenu;
class QWidget;

namespace pellucid::ui {

/// The manual, the keys, and what the program is made of.
void addHelpMenu(QMenu &menu, QWidget &window);

} // namespace pellucid::ui
