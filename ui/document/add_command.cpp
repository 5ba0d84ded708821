// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/add_command.h"

#include <QAction>
#include <QMenu>

namespace pellucid::ui {

QAction *addCommand(QMenu &menu, const QString &text, const char *name, const QKeySequence &key,
                    QObject *owner, const std::function<void()> &run) {
    QAction *action = menu.addAction(text);
    action->setObjectName(name);
    action->setShortcut(key);
    QObject::connect(action, &QAction::triggered, owner, [run] { run(); });
    return action;
}

} // namespace pellucid::ui
