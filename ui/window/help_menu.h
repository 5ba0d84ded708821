// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/task/reason.h"

class QMenu;
class QWidget;

namespace pellucid::ui {

/// Adds the manual, which opens in the browser, and the About dialog. `failed`: why the manual does
/// not open, and its file.
void addHelpMenu(QMenu &menu, QWidget &window,
                 const std::function<void(const task::Reason &, const QString &)> &failed);

} // namespace pellucid::ui
