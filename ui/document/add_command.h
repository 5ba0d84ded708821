// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QKeySequence>

class QAction;
class QMenu;
class QObject;

namespace pellucid::ui {

/// An entry of a menu. *Shape*: `name` is what tests and the list of shortcuts find it by; `owner`:
/// nothing is run after its end.
QAction *addCommand(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                    QObject *owner, const std::function<void()> &run);

} // namespace pellucid::ui
