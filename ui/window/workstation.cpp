// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workstation.h"

#include <QApplication>
#include <QLibraryInfo>
#include <QLocale>

#include "ui/opening/recent_paths.h"
#include "ui/opening/session.h"
#include "ui/theme/theme.h"
#include "ui/window/main_window.h"

namespace pellucid::ui {

namespace {

constexpr int keepingMs = 1500;

} // namespace

Workstation::Workstation(std::optional<EngineChoice> engine)
    : m_preferences(Preferences::load()), m_bench(engine) {
    installTranslations(m_preferences.language);
    Theme::named(m_preferences.theme).apply(*qApp);
    m_window = std::make_unique<MainWindow>(m_bench, m_preferences);
    connect(m_window.get(), &MainWindow::preferencesChanged, this, &Workstation::follow);
    m_window->show();
    m_keeping.setSingleShot(true);
    m_keeping.setInterval(keepingMs);
    connect(&m_keeping, &QTimer::timeout, this, [this] { keepWhatIsOpen(false); });
    m_bench.study.document.whenever(viewChanges, this, [this] {
        if (!m_keeping.isActive()) // a long drag does not postpone it
            m_keeping.start();
    });
}

Workstation::~Workstation() {
    keepWhatIsOpen(true);
    // While the timer still exists: a study beside that closes resizes the panes, which changes the
    // scene.
    m_window.reset();
}

void Workstation::keepWhatIsOpen(bool hasEnded) {
    if (!m_preferences.remembersStudies) {
        m_bench.session.forget();
        return;
    }
    // If nothing was opened, the previous session stays. A study that was closed on purpose is not
    // offered as crash recovery.
    auto session = currentSession(m_bench.study.document);
    if (!session && hasEnded && m_hasKept)
        session = m_bench.session.kept();
    if (!session)
        return;
    m_hasKept = true;
    session->hasEnded = hasEnded;
    // It may hold paths that name a patient; so does the library, in the same private folder.
    m_bench.session.keep(*session);
}

// The texts of the program are English; a text without a translation stays English.
void Workstation::installTranslations(const QString &language) {
    const QLocale locale = language.isEmpty() ? QLocale() : QLocale(language);
    // English has a file, too, for its plurals.
    if (m_texts.load(locale, "pellucid", "_", ":/i18n"))
        QCoreApplication::installTranslator(&m_texts);
    if (m_qtTexts.load(locale, "qtbase", "_", QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
        QCoreApplication::installTranslator(&m_qtTexts);
}

void Workstation::follow(const Preferences &preferences) {
    const Preferences before = m_preferences;
    m_preferences = preferences;
    if (!preferences.remembersStudies) {
        m_bench.session.forgetAll();
        forgetRecentPaths();
    }
    if (before.showsPatient && !preferences.showsPatient)
        forgetPaths();
    if (preferences.theme != before.theme)
        Theme::named(preferences.theme).apply(*qApp);
    m_window->setPreferences(preferences);
}

} // namespace pellucid::ui
