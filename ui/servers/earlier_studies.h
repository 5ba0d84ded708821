// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <QObject>

#include "ui/jobs/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/servers/remote_study.h"
#include "ui/servers/server_book.h"

namespace pellucid::ui {

/// Another study of the patient.
struct EarlierStudy {
    StudyFacts study; ///< with the library's number if it is there
    QStringList servers;
    int instances = 0;      ///< as a server counts them; 0: unknown
    bool isCertain = false; ///< false: perhaps of another patient

    bool isHere() const { return study.libraryId != 0; }
    RemoteStudy remote() const { return {study, servers, instances}; }
};

/// The other studies of the patient whose study is open, in the library and on servers. Servers are
/// asked only while the list is in use.
class EarlierStudies : public QObject {
    Q_OBJECT
public:
    EarlierStudies(StudyLibrary &library, ServerBook &book, QObject *parent = nullptr);

    /// The study that is open; none: an empty list.
    void setOpenStudy(const std::optional<StudyFacts> &study);
    /// Whether a panel shows the list.
    void setShown(bool isShown);
    /// How many of the latest studies are retrieved in advance, 0 to 3. Stored in the settings.
    int inAdvance() const { return m_inAdvance; }
    void setInAdvance(int count);

    /// The latest first; those that are perhaps of another patient at the end.
    const std::vector<EarlierStudy> &studies() const { return m_studies; }
    /// Servers that could not be asked, with the reasons.
    const std::map<QString, task::Reason> &failures() const { return m_failures; }
    /// Servers that have more than they may answer.
    const QStringList &limited() const { return m_limited; }
    bool hasOpenStudy() const { return m_open.has_value(); }
    bool isSearching() const { return m_jobs.isRunning(); }

signals:
    void changed();
    /// It may be wanted soon.
    void retrievalSuggested(const pellucid::ui::RemoteStudy &study);

private:
    void search();
    void searchServers(const std::vector<archive::Server> &servers);
    void listLibrary();
    void merge();
    void suggest();

    StudyLibrary &m_library;
    ServerBook &m_book;
    std::optional<StudyFacts> m_open;
    bool m_isShown = false, m_hasAsked = false;
    int m_inAdvance = 0;
    quint64 m_generation = 0;
    std::vector<StudyFacts> m_here;
    std::vector<RemoteStudy> m_remote;
    std::vector<EarlierStudy> m_studies;
    std::map<QString, task::Reason> m_failures;
    QStringList m_limited;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
