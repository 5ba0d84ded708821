// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QKeySequence>
#include <QString>

class QAction;
class QMenu;
class QWidget;

namespace pellucid::ui {

/// An action of a window that can have a key.
struct ShortcutEntry {
    QAction *action = nullptr;
    QString name; ///< the settings key
    QString text; ///< the text shown to the user, with its menu
    QKeySequence defaultKey;
};

/// Every named action of a window's menus, in menu order.
std::vector<ShortcutEntry> shortcutEntries(const QWidget &window);
/// Applies the user's keys to the actions of a window, whose tooltips name them.
void applyShortcuts(const QWidget &window);
/// The same for one menu, whose actions are made again.
void applyShortcuts(const QMenu &menu);
/// Sets and stores the key of an action. The default key is not stored.
void setShortcut(const ShortcutEntry &entry, const QKeySequence &key);

} // namespace pellucid::ui
