// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workstation.h"

#include <QApplication>
#include <QLibraryInfo>
#include <QLocale>

#include "ui/opening/recent_paths.h"
#include "ui/opening/session.h"
#include "ui/window/main_window.h"
#include "ui/window/preferences_dialog.h"

namespace pellucid::ui {

namespace {

constexpr int keepingMs = 1500;

} // namespace

Workstation::Workstation(std::optional<EngineChoice> engine)
    : m_preferences(Preferences::load()), m_bench(engine) {
    speak(m_preferences.language);
    makeWindow();
    m_keeping.setSingleShot(true);
    m_keeping.setInterval(keepingMs);
    connect(&m_keeping, &QTimer::timeout, this, [this] { keepWhatIsOpen(false); });
    for (const auto changed :
         {&Document::volumeChanged, &Document::sceneChanged, &Document::poseChanged,
          &Document::projectionResized, &Document::displayWindowChanged, &Document::exposureChanged,
          &Document::crosshairChanged, &Document::cutChanged, &Document::segmentsChanged})
        connect(&m_bench.study.document, changed, this, [this] {
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
void Workstation::speak(const QString &language) {
    QCoreApplication::removeTranslator(&m_texts);
    QCoreApplication::removeTranslator(&m_ofQt);
    const QLocale locale = language.isEmpty() ? QLocale() : QLocale(language);
    // English has a file, too, for its plurals.
    if (m_texts.load(locale, "pellucid", "_", ":/i18n"))
        QCoreApplication::installTranslator(&m_texts);
    if (m_ofQt.load(locale, "qtbase", "_", QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
        QCoreApplication::installTranslator(&m_ofQt);
}

void Workstation::makeWindow() {
    const Theme theme = Theme::named(m_preferences.theme);
    theme.apply(*qApp);
    const bool wasThere = m_window != nullptr;
    QByteArray geometry;
    if (wasThere) {
        geometry = m_window->saveGeometry();
        m_window->keepLayout();
    }
    std::optional<PreferencesDialog::Place> preferences; // the user is making a choice in it
    if (wasThere)
        if (const auto *const dialog = m_window->findChild<PreferencesDialog *>())
            preferences = dialog->place();
    m_window.reset();
    m_window = std::make_unique<MainWindow>(m_bench, theme, m_preferences);
    if (wasThere)
        m_window->restoreGeometry(geometry);
    connect(m_window.get(), &MainWindow::preferencesChanged, this, &Workstation::follow);
    m_window->show();
    if (preferences)
        m_window->openPreferences().setPlace(*preferences);
}

// Exports refer to the panes: they finish first.
void Workstation::makeWindowWhenIdle() {
    if (m_bench.exports.isRunning())
        connect(&m_bench.exports, &JobRunner::finished, this, &Workstation::makeWindowWhenIdle,
                Qt::ConnectionType(Qt::QueuedConnection | Qt::SingleShotConnection));
    else
        makeWindow();
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
    if (preferences.language != before.language)
        speak(preferences.language);
    if (preferences.language != before.language || preferences.theme != before.theme ||
        preferences.toolBar != before.toolBar)
        // Queued: the caller is a dialog of the old window.
        QMetaObject::invokeMethod(this, &Workstation::makeWindowWhenIdle, Qt::QueuedConnection);
    else
        m_window->setPreferences(preferences);
}

} // namespace pellucid::ui
