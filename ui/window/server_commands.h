// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QObject>
#include <QStringList>

#include "core/archive/retrieval.h"
#include "ui/jobs/job_runner.h"
#include "ui/servers/awaited_studies.h"
#include "ui/servers/earlier_studies.h"
#include "ui/servers/open_request.h"
#include "ui/servers/remote_study.h"

class QMainWindow;

namespace pellucid::ui {

struct Workbench;
class StudyDocks;
class StudyPair;

/// The commands that concern servers: the dialog, retrieving, sending, links of other programs,
/// earlier studies, and what happens when a study has arrived.
class ServerCommands : public QObject {
    Q_OBJECT
public:
    ServerCommands(QMainWindow &window, Workbench &bench, StudyDocks &docks, StudyPair &pair);

    void showServers();
    /// Opens what a link asks for: from a known server only, and after the user has allowed links
    /// for it.
    void open(const OpenRequest &request);

private:
    void connectTransfers();
    void completed(const QString &folder, bool isAskedFor, const archive::RetrievalReport &report);
    /// Offers to replace what the archive has corrected.
    void askToReplace(const QString &studyUid, const archive::RetrievalReport &report,
                      const std::function<void()> &cancelled);
    /// A server may send anybody's images: they are not shown as those of the patient listed.
    void askForAnotherPatient(const archive::Patient &listed, const archive::Patient &named,
                              const std::function<void()> &open);
    void connectEarlier();
    void retrieve(const RemoteStudy &study);
    void find(const OpenRequest &request);
    void openBeside(const EarlierStudy &study);
    /// Opens the awaited study beside if all of it is here, and listed.
    void openAwaitedBeside();
    /// Opens a study of the library beside; false if it is not there.
    bool openHere(const StudyFacts &study);
    void send(const QStringList &files, const QString &server);

    QMainWindow &m_window;
    Workbench &m_bench;
    StudyDocks &m_docks;
    StudyPair &m_pair;
    AwaitedStudies m_awaited;
    JobRunner m_finding; ///< looks for what a link names
};

} // namespace pellucid::ui
