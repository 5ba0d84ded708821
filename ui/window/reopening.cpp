// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/reopening.h"

#include <algorithm>
#include <utility>

#include <QDir>

#include "ui/opening/recent_paths.h"
#include "ui/opening/session.h"
#include "ui/panels/start_page.h"

namespace pellucid::ui {

Reopening::Reopening(Workbench &bench, StartPage &page, const Preferences &preferences,
                     QObject *parent)
    : QObject(parent), m_bench(bench), m_page(page), m_preferences(preferences) {
    connect(&page, &StartPage::recentRequested, this, &Reopening::openRecent);
    connect(&page, &StartPage::resumeRequested, this, &Reopening::resume);
    connect(&bench.study.opener, &StudyOpener::pathsOpened, this, &Reopening::rememberPaths);
    show();
}

void Reopening::setPreferences(const Preferences &preferences) {
    m_preferences = preferences;
    show();
}

void Reopening::openFromLibrary(const StudyFacts &study, const VolumeFacts &volume) {
    std::vector<VolumeFacts> series = m_bench.library.volumes(study);
    std::erase_if(series, [&](const VolumeFacts &v) {
        return v.seriesUid != volume.seriesUid || v.file != volume.file;
    });
    // Opening rebuilds the list that `study` and `volume` refer to.
    const QString entry = recentEntry(study);
    m_bench.study.opener.openFromLibrary(StudyFacts(study), series, volume.key(),
                                         m_bench.library.files(study, volume));
    remember({entry});
}

void Reopening::resume() {
    if (const auto session = m_bench.session.kept())
        ui::resume(*session, m_bench.study.opener);
}

void Reopening::forgetAll() {
    forgetRecentPaths();
    m_bench.session.forgetAll();
    show();
}

void Reopening::rememberPaths(QStringList paths) {
    QStringList entries;
    const Document &document = m_bench.study.document;
    for (const QString &path : paths) {
        if (mayBeKept(path, document)) {
            entries << path;
            continue;
        }
        forgetRecentPath(path); // remembered when this was allowed
        const auto named = std::find_if(
            document.sources().begin(), document.sources().end(),
            [&](const StudySource &source) { return namesPatient(path, source.study); });
        if (!m_preferences.remembersStudies || named == document.sources().end())
            continue;
        const StudyFacts &study = named->study;
        if (const auto entry =
                privateEntry(path, (dateText(study.date) + " " + study.modalities).simplified()))
            entries << *entry;
    }
    remember(entries);
}

// Opens the volume with the most samples, as for a folder.
void Reopening::openRecent(const QString &entry) {
    const auto study = recentStudy(entry, m_bench.library);
    if (!study) {
        if (const QString path = pathOf(entry); !path.isEmpty())
            m_bench.study.opener.openPaths({path});
        else
            forgetRecentPath(entry);
        show();
        return;
    }
    const auto volumes = m_bench.library.volumes(*study);
    const auto largest =
        std::max_element(volumes.begin(), volumes.end(), [](const auto &a, const auto &b) {
            return std::pair(a.placed, a.size.count()) < std::pair(b.placed, b.size.count());
        });
    if (largest != volumes.end())
        openFromLibrary(*study, *largest);
}

void Reopening::remember(const QStringList &entries) {
    if (m_preferences.remembersStudies)
        addRecentPaths(entries);
    show();
}

void Reopening::show() {
    const bool remembers = m_preferences.remembersStudies;
    std::vector<StartPage::Recent> recent;
    for (const QString &entry : remembers ? recentPaths() : QStringList()) {
        const auto study = recentStudy(entry, m_bench.library);
        if (study)
            recent.push_back({m_preferences.showsPatient
                                  ? patientText(*study) + ", " + studyText(*study)
                                  : studyText(*study),
                              entry});
        else if (const QString label = privateLabel(entry); !label.isEmpty())
            recent.push_back({label, entry});
        else if (QDir::isAbsolutePath(entry))
            recent.push_back({QDir::toNativeSeparators(entry), entry});
    }
    m_page.setRecent(recent);
    const auto session = remembers ? m_bench.session.kept() : std::nullopt;
    m_page.setOffersResuming(session.has_value(), session && session->hasEnded);
}

} // namespace pellucid::ui
