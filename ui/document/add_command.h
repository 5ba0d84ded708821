// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QKeySequence>

class QAction;
class QMenu;
class QObject;

namespace pellucid::ui {

/// Adds an action to a menu. `name`: its object name, by which tests and the list of shortcuts find
/// it. `owner`: when it is destroyed, the action runs nothing any more.
QAction *addCommand(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                    QObject *owner, const std::function<void()> &run);

} // namespace pellucid::ui
