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

/// The running program: the bench, the window over it, language and theme. A language that
/// the user chooses is spoken from the next start.
class Workstation : public QObject {
    Q_OBJECT
public:
    explicit Workstation(std::optional<EngineChoice> engine = std::nullopt);
    ~Workstation() override;

    Workbench &bench() { return m_bench; }
    MainWindow &window() { return *m_window; }

private:
    void follow(const Preferences &preferences);
    void installTranslations(const QString &language);
    void keepWhatIsOpen(bool hasEnded);

    Preferences m_preferences;
    QTranslator m_texts, m_qtTexts;
    Workbench m_bench;
    std::unique_ptr<MainWindow> m_window;
    bool m_hasKept = false; ///< in this run
    QTimer m_keeping;       ///< runs from a change until the session is kept
};

} // namespace pellucid::ui
