// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include <QHash>
#include <QKeySequence>
#include <QObject>
#include <QString>

class QAction;
class QActionGroup;
class QMenu;
class QMenuBar;

namespace pellucid::ui {

/// Something that the user can have done: a row of the table of actions.
struct Command {
    QString id;   ///< by which menus, settings and tests know it
    QString text; ///< in menus, with an access key
    QString key;  ///< at first; the user may choose another
    QString icon; ///< of resources/icons, for buttons; menus show text only
    std::function<void()> run;
    std::function<bool()> isEnabled; ///< always, if empty
    std::function<bool()> isChecked; ///< it cannot be checked, if empty
    QString label;                   ///< of a button, if it is shorter than the text
    QString tip;                     ///< of a button, if the label does not say it all
    QString fixedKey;                ///< a key of the panes that does the same
    QString group;                   ///< of actions that are alternatives
    QAction *action = nullptr;       ///< if another object makes it; its text is its own
};

/// What a menu contains: a command, a submenu, or, if both are empty, a separator.
struct MenuEntry {
    QString id;    ///< of a command, or the name of a submenu, which may be empty
    QString title; ///< of a submenu
    std::vector<MenuEntry> entries;
};

/// The actions of a window: the only place where they are made. Menus, tool bar, pane menus and the
/// list of keys show what it holds.
class ActionTable : public QObject {
    Q_OBJECT
public:
    struct Row {
        Command command;
        QAction *action;
        QKeySequence defaultKey;
        QString path; ///< the text with its menus, once it is in the menu bar
    };

    using QObject::QObject;

    void add(std::vector<Command> commands);
    /// *Requires* that there is such a row.
    QAction *operator[](const QString &id) const;
    /// Fills a menu that repeats rows of the menu bar.
    void fill(QMenu &menu, const std::vector<MenuEntry> &entries) { fill(menu, entries, {}); }
    /// Adds a menu to the menu bar; its rows are listed with their keys.
    void fill(QMenuBar &bar, const MenuEntry &menu);
    /// A submenu that `fill` made under a name. *Requires* that there is one.
    QMenu *menu(const QString &name) const;
    /// Enables and checks all actions as the program is now.
    void refresh();

    /// The rows of the menu bar, in its order.
    const std::vector<const Row *> &listed() const { return m_listed; }
    /// Gives a row a key and remembers it.
    void setKey(const Row &row, const QKeySequence &key);

private:
    /// `path`: the menus above, for rows that are listed.
    void fill(QMenu &menu, const std::vector<MenuEntry> &entries, const QString &path);
    void make(Row &row);
    static void showKey(const Row &row);

    std::deque<Row> m_rows; // stays in place
    QHash<QString, Row *> m_byId;
    QHash<QString, QActionGroup *> m_groups;
    QHash<QString, QMenu *> m_menus;
    std::vector<const Row *> m_listed;
};

} // namespace pellucid::ui
