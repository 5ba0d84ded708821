// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QKeySequence>
#include <QString>

class QAction;
class QWidget;

namespace pellucid::ui {

/// A command of a window that can have a key.
struct ShortcutEntry {
    QAction *action = nullptr;
    QString name; ///< what it is kept under
    QString text; ///< with its menu, as it is read there
    QKeySequence defaultKey;
};

/// Every named command of a window's menus, in their order.
std::vector<ShortcutEntry> shortcutEntries(const QWidget &window);
/// Gives the commands of a window the keys that the user has chosen.
void applyShortcuts(const QWidget &window);
/// Keeps a key for a command; its usual one is what is kept under no name.
void setShortcut(const ShortcutEntry &entry, const QKeySequence &key);

} // namespace pellucid::ui
