// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <QObject>
#include <QTimer>
#include <QTranslator>

#include "ui/settings/preferences.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

class MainWindow;

/// The running program: the bench, the window over it, language and theme. A change of language or
/// theme makes a new window; the bench stays.
class Workstation : public QObject {
    Q_OBJECT
public:
    explicit Workstation(std::optional<EngineChoice> engine = std::nullopt);
    ~Workstation() override;

    Workbench &bench() { return m_bench; }
    MainWindow &window() { return *m_window; }

private:
    void follow(const Preferences &preferences);
    void makeWindow();
    void makeWindowWhenIdle();
    void speak(const QString &language);
    void keepWhatIsOpen(bool hasEnded);

    Preferences m_preferences;
    QTranslator m_texts, m_ofQt;
    Workbench m_bench;
    std::unique_ptr<MainWindow> m_window;
    bool m_hasKept = false; ///< in this run
    QTimer m_keeping;       ///< runs from a change until the session is kept
};

} // namespace pellucid::ui
