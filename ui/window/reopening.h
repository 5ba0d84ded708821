// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QStringList>

#include "ui/settings/preferences.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

class StartPage;

/// Remembers what the user opens, as far as the preferences allow, and lets the start page reopen
/// it.
class Reopening : public QObject {
    Q_OBJECT
public:
    Reopening(Workbench &bench, StartPage &page, const Preferences &preferences,
              QObject *parent = nullptr);

    void setPreferences(const Preferences &preferences);
    /// Opens a study of the library and remembers it by its number there.
    void openFromLibrary(const StudyFacts &study, const VolumeFacts &volume);
    /// Reopens the last session.
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
