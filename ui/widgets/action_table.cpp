// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/action_table.h"

#include <cassert>
#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QSettings>

#include "ui/language/shown_text.h"
#include "ui/theme/icons.h"

namespace pellucid::ui {

namespace {

QString settingsKey(const QString &id) {
    return "shortcuts/" + id;
}

QString plain(QString text) {
    text = text.section('\t', 0, 0); // a hint of a fixed key follows the tab
    // Chinese puts the access key in brackets after the text.
    static const QRegularExpression accessKey("\\(&.\\)");
    return text.remove(accessKey).remove('&').remove("...").remove(QString::fromUtf8("…"));
}

} // namespace

void ActionTable::add(std::vector<Command> commands) {
    const QSettings settings;
    for (Command &command : commands) {
        Row &row = m_rows.emplace_back(Row{std::move(command), nullptr, {}, {}});
        assert(!m_byId.contains(row.command.id));
        m_byId.insert(row.command.id, &row);
        make(row);
        row.defaultKey = QKeySequence(row.command.key, QKeySequence::PortableText);
        const QVariant chosen = settings.value(settingsKey(row.command.id));
        row.action->setShortcut(chosen.isValid()
                                    ? QKeySequence(chosen.toString(), QKeySequence::PortableText)
                                    : row.defaultKey);
        showKey(row);
    }
}

void ActionTable::make(Row &row) {
    const Command &command = row.command;
    row.action = command.action;
    if (row.action == nullptr) {
        const QString fixedKey = command.fixedKey.isEmpty() ? "" : "\t" + command.fixedKey;
        row.action = new QAction(command.text + fixedKey, this);
    }
    QAction &action = *row.action;
    action.setObjectName(command.id);
    if (!command.label.isEmpty())
        action.setIconText(command.label);
    if (!command.icon.isEmpty())
        action.setIcon(themedIcon(command.icon));
    action.setIconVisibleInMenu(false);
    if (command.isChecked)
        action.setCheckable(true);
    if (!command.group.isEmpty()) {
        QActionGroup *&group = m_groups[command.group];
        if (group == nullptr) {
            group = new QActionGroup(this);
            group->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
        }
        action.setActionGroup(group);
    }
    if (command.run)
        connect(&action, &QAction::triggered, this, [this, run = command.run] {
            run();
            refresh(); // a click on what is checked would uncheck it
        });
}

QAction *ActionTable::operator[](const QString &id) const {
    const Row *const row = m_byId.value(id);
    assert(row != nullptr);
    return row->action;
}

QMenu *ActionTable::menu(const QString &name) const {
    assert(m_menus.contains(name));
    return m_menus.value(name);
}

void ActionTable::fill(QMenu &menu, const std::vector<MenuEntry> &entries, const QString &path) {
    for (const MenuEntry &entry : entries) {
        if (!entry.title.isEmpty()) {
            QMenu *const submenu = menu.addMenu(entry.title);
            if (!entry.id.isEmpty()) {
                submenu->setObjectName(entry.id);
                m_menus.insert(entry.id, submenu);
            }
            fill(*submenu, entry.entries,
                 path.isEmpty() ? path : path + plain(entry.title) + " > ");
        } else if (entry.id.isEmpty()) {
            menu.addSeparator();
        } else if (m_menus.contains(entry.id)) {
            menu.addMenu(m_menus[entry.id]);
        } else {
            menu.addAction((*this)[entry.id]);
            if (path.isEmpty())
                continue;
            Row &row = *m_byId[entry.id];
            row.path = path + plain(row.action->text());
            m_listed.push_back(&row);
        }
    }
    connect(&menu, &QMenu::aboutToShow, this, &ActionTable::refresh);
}

void ActionTable::fill(QMenuBar &bar, const MenuEntry &menu) {
    QMenu *const made = bar.addMenu(menu.title);
    if (!menu.id.isEmpty())
        m_menus.insert(menu.id, made);
    fill(*made, menu.entries, plain(menu.title) + " > ");
}

void ActionTable::refresh() {
    for (const Row &row : m_rows) {
        if (row.command.isEnabled)
            row.action->setEnabled(row.command.isEnabled());
        if (row.command.isChecked)
            row.action->setChecked(row.command.isChecked());
    }
}

void ActionTable::setKey(const Row &row, const QKeySequence &key) {
    row.action->setShortcut(key);
    showKey(row);
    const QString id = settingsKey(row.command.id);
    if (key == row.defaultKey)
        QSettings().remove(id);
    else
        QSettings().setValue(id, key.toString(QKeySequence::PortableText));
}

// Buttons name the key in their tooltips.
void ActionTable::showKey(const Row &row) {
    const Command &command = row.command;
    const QString tip = !command.tip.isEmpty()     ? command.tip
                        : !command.label.isEmpty() ? command.label
                                                   : plain(row.action->text());
    const QString key = row.action->shortcut().toString(QKeySequence::NativeText);
    row.action->setToolTip(plainToolTip(key.isEmpty() ? tip : QString("%1 (%2)").arg(tip, key)));
}

} // namespace pellucid::ui
