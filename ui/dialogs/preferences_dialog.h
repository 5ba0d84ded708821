// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "ui/settings/preferences.h"
#include "ui/widgets/action_table.h"

class QCheckBox;
class QComboBox;
class QKeySequenceEdit;
class QLineEdit;
class QTreeWidget;

namespace pellucid::ui {

class PlainLabel;

/// The preferences and the keys of all actions. Changes are saved and, but for the language, take
/// effect at once.
class PreferencesDialog : public QDialog {
    Q_OBJECT
public:
    /// `spoken`: the preferred language when the program started.
    PreferencesDialog(ActionTable &actions, const QString &spoken, QWidget *window);

signals:
    void changed(const pellucid::ui::Preferences &preferences);

private:
    QWidget *makeGeneral();
    QWidget *makeShortcuts();
    void change();
    void showShortcuts();
    void showChosenKey();
    void assignKey();
    /// The selected row; null if there is none.
    const ActionTable::Row *chosen() const;

    ActionTable &m_actions;
    const QString m_spoken;
    QComboBox *m_language, *m_theme, *m_toolBar;
    QCheckBox *m_remembers, *m_resumes, *m_title;
    QLineEdit *m_filter;
    QTreeWidget *m_commands;
    QKeySequenceEdit *m_key;
    PlainLabel *m_conflict;
};

} // namespace pellucid::ui
