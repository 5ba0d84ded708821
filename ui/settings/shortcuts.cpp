// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/settings/shortcuts.h"

#include <QAction>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QSettings>

#include "ui/language/shown_text.h"

namespace pellucid::ui {

namespace {

constexpr const char *defaultProperty = "defaultShortcut", *tipProperty = "toolTipWithoutKey";

QString settingsKey(const QString &name) {
    return "shortcuts/" + name;
}

QString plain(QString text) {
    text = text.section('\t', 0, 0); // a hint of a fixed key follows the tab
    // Chinese puts the access key in brackets after the text.
    static const QRegularExpression accessKey("\\(&.\\)");
    return text.remove(accessKey).remove('&').remove("...").remove(QString::fromUtf8("…"));
}

// Remember the default key before it is changed for the first time.
QKeySequence defaultKeyOf(QAction *action) {
    const QVariant known = action->property(defaultProperty);
    if (known.isValid())
        return QKeySequence(known.toString(), QKeySequence::PortableText);
    action->setProperty(defaultProperty, action->shortcut().toString(QKeySequence::PortableText));
    return action->shortcut();
}

// Names the key in the tooltip, as tool buttons show it.
void showKey(QAction &action) {
    if (!action.property(tipProperty).isValid())
        action.setProperty(tipProperty, plain(action.toolTip()));
    const QString tip = action.property(tipProperty).toString();
    const QString key = action.shortcut().toString(QKeySequence::NativeText);
    action.setToolTip(plainToolTip(key.isEmpty() ? tip : QString("%1 (%2)").arg(tip, key)));
}

void add(const QMenu &menu, const QString &path, std::vector<ShortcutEntry> &entries) {
    for (QAction *action : menu.actions()) {
        const QString text = path + plain(action->text());
        if (action->menu() != nullptr)
            add(*action->menu(), text + " > ", entries);
        else if (!action->isSeparator() && !action->objectName().isEmpty())
            entries.push_back({action, action->objectName(), text, defaultKeyOf(action)});
    }
}

} // namespace

std::vector<ShortcutEntry> shortcutEntries(const QWidget &window) {
    std::vector<ShortcutEntry> entries;
    const auto *const main = qobject_cast<const QMainWindow *>(&window);
    for (QAction *top : main->menuBar()->actions())
        if (top->menu() != nullptr)
            add(*top->menu(), plain(top->text()) + " > ", entries);
    return entries;
}

namespace {

void apply(const std::vector<ShortcutEntry> &entries) {
    const QSettings settings;
    for (const ShortcutEntry &entry : entries) {
        if (const QVariant chosen = settings.value(settingsKey(entry.name)); chosen.isValid())
            entry.action->setShortcut(QKeySequence(chosen.toString(), QKeySequence::PortableText));
        showKey(*entry.action);
    }
}

} // namespace

void applyShortcuts(const QWidget &window) {
    apply(shortcutEntries(window));
}

void applyShortcuts(const QMenu &menu) {
    std::vector<ShortcutEntry> entries;
    add(menu, {}, entries);
    apply(entries);
}

void setShortcut(const ShortcutEntry &entry, const QKeySequence &key) {
    entry.action->setShortcut(key);
    showKey(*entry.action);
    if (key == entry.defaultKey)
        QSettings().remove(settingsKey(entry.name));
    else
        QSettings().setValue(settingsKey(entry.name), key.toString(QKeySequence::PortableText));
}

} // namespace pellucid::ui
