// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QStringList>

#include "ui/settings/preferences.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

class StartPage;

/// What was open before and can be opened again: the start page offers it, and what the user opens
/// is remembered there, as far as the preferences let it.
class Reopening : public QObject {
    Q_OBJECT
public:
    Reopening(Workbench &bench, StartPage &page, const Preferences &preferences,
              QObject *parent = nullptr);

    void setPreferences(const Preferences &preferences);
    /// A study of the library is remembered by its number there.
    void openFromLibrary(const StudyFacts &study, const VolumeFacts &volume);
    /// What was open when the program ended.
    void resume();
    void forgetAll();

private:
    void rememberPaths(QStringList paths);
    void openRecent(const QString &entry);
    void remember(const QStringList &entries);
    void show();

    Workbench &m_bench;
    StartPage &m_page;
    Preferences m_preferences;
};

} // namespace pellucid::ui
