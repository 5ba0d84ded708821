// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/server_commands.h"

#include <algorithm>
#include <tuple>

#include <QDockWidget>
#include <QFileInfo>
#include <QMainWindow>
#include <QPointer>
#include <QSettings>

#include "core/archive/reasons.h"
#include "core/archive/sending.h"
#include "ui/beside/study_pair.h"
#include "ui/dialogs/servers_dialog.h"
#include "ui/language/reasons.h"
#include "ui/panels/earlier_panel.h"
#include "ui/panels/study_panel.h"
#include "ui/panels/transfers_panel.h"
#include "ui/widgets/dialog_place.h"
#include "ui/widgets/question.h"
#include "ui/window/study_docks.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

namespace {

// The servers that links may name without a question.
constexpr auto allowedKey = "links/allowedServers";

} // namespace

ServerCommands::ServerCommands(QMainWindow &window, Workbench &bench, StudyDocks &docks,
                               StudyPair &pair)
    : QObject(&window), m_window(window), m_bench(bench), m_docks(docks), m_pair(pair) {
    connect(&docks.studies(), &StudyPanel::retrieveRequested, this, &ServerCommands::retrieve);
    connect(&docks.studies(), &StudyPanel::sendRequested, this, &ServerCommands::send);
    connect(&docks.transfersPanel(), &TransfersPanel::sendRequested, this, &ServerCommands::send);
    connectTransfers();
    connectEarlier();
    // After the window has connected to the signals.
    QMetaObject::invokeMethod(
        this, [this] { m_bench.transfers.resume(&m_window); }, Qt::QueuedConnection);
}

void ServerCommands::connectTransfers() {
    m_bench.study.document.whenever(Change::currentSource, this,
                                    [this] { m_awaited.forgetStudy(); });
    connect(&m_bench.transfers, &TransferQueue::arriving, this,
            [this](const QString &uid, const std::shared_ptr<dicom::ArrivingSeries> &series) {
                if (const auto study = m_awaited.arriving(uid))
                    m_bench.study.opener.openArriving(*study, series);
            });
    connect(&m_bench.receiver, &StudyReceiver::arrived, this,
            [this] { m_bench.notices.say(tr("Study received")); });
    connect(&m_bench.transfers, &TransferQueue::completed, this, &ServerCommands::completed);
}

void ServerCommands::completed(const QString &folder, bool isAskedFor,
                               const archive::RetrievalReport &report) {
    using Then = AwaitedStudies::Then;
    const QString uid = QFileInfo(folder).fileName();
    const bool isIdle =
        m_bench.study.document.currentSource() < 0 && !m_bench.study.jobs.isRunning();
    const auto arrival = m_awaited.completed(uid, report, isAskedFor, isIdle);
    const auto open = [this, folder] { m_bench.study.opener.openPaths({folder}); };
    const auto askForOther = [this, report, open] {
        askForAnotherPatient(report.listed, report.named, open);
    };
    const bool isOfAnother = arrival.then == Then::askAboutPatient;
    if (arrival.asksToReplace)
        askToReplace(uid, report, isOfAnother ? askForOther : std::function<void()>());
    else if (isOfAnother)
        askForOther();
    if (arrival.then == Then::openBeside)
        openAwaitedBeside();
    if (arrival.then == Then::open)
        open();
    else if (arrival.then == Then::say || arrival.then == Then::openBeside)
        m_bench.notices.say(tr("Study received"));
}

void ServerCommands::askToReplace(const QString &studyUid, const archive::RetrievalReport &report,
                                  const std::function<void()> &cancelled) {
    QStringList corrections;
    for (const archive::Correction &correction : report.corrections)
        corrections << translated(archive::reasonOf(correction));
    ask(
        &m_window,
        {"correctedQuestion", tr("Corrected data"),
         tr("The server has corrected this study since %n of its images were received:\n\n"
            "%1\n\nRetrieve these images again, and replace the copies on this computer?",
            "", int(report.corrected))
             .arg(corrections.join("\n")),
         tr("Replace")},
        [this, studyUid] { m_bench.transfers.replace(studyUid, &m_window); }, cancelled);
}

void ServerCommands::askForAnotherPatient(const archive::Patient &listed,
                                          const archive::Patient &named,
                                          const std::function<void()> &open) {
    const auto textOf = [](const archive::Patient &patient) {
        const auto shown = [](const std::string &text) { return QString::fromStdString(text); };
        QStringList parts{personText(shown(patient.name)), shown(patient.id),
                          dateText(shown(patient.birthDate))};
        parts.removeAll({});
        return parts.join(", ");
    };
    ask(&m_window,
        {"anotherPatientQuestion", tr("Another patient"),
         tr("The server lists the study for one patient, but images of it name another.\n\n"
            "Listed: %1\nNamed: %2\n\nThe study is in the library. Open it?")
             .arg(textOf(listed), textOf(named)),
         tr("Open")},
        open);
}

void ServerCommands::connectEarlier() {
    const auto follow = [this] {
        const Document &document = m_bench.study.document;
        const int source = document.currentSource();
        std::optional<StudyFacts> study;
        if (source >= 0)
            study = document.sources()[std::size_t(source)].study;
        m_bench.earlier.setOpenStudy(study);
        m_awaited.setOpen(study ? study->key() : QString());
    };
    m_bench.study.document.whenever(Change::currentSource | Change::sources, this, follow);
    connect(&m_bench.earlier, &EarlierStudies::retrievalSuggested, this,
            [this](const RemoteStudy &study) {
                m_bench.transfers.add(study, nullptr, TransferQueue::Urgency::later);
            });
    connect(&m_docks.earlier(), &EarlierPanel::besideRequested, this, &ServerCommands::openBeside);
    // It is listed some time after it has arrived.
    connect(&m_bench.library, &StudyLibrary::changed, this, &ServerCommands::openAwaitedBeside);
    follow();
}

void ServerCommands::retrieve(const RemoteStudy &study) {
    m_docks.transfers().show();
    m_docks.transfers().raise();
    m_awaited.await(study.study);
    m_bench.transfers.add(study, &m_window);
}

void ServerCommands::openBeside(const EarlierStudy &study) {
    m_awaited.forgetBeside();
    if (m_bench.study.document.currentSource() < 0 || openHere(study.study) ||
        study.servers.isEmpty())
        return;
    const Document &document = m_bench.study.document;
    m_awaited.awaitBeside(study.study,
                          document.sources()[std::size_t(document.currentSource())].study.key());
    m_docks.transfers().show();
    m_docks.transfers().raise();
    m_bench.transfers.add(study.remote(), &m_window);
}

void ServerCommands::openAwaitedBeside() {
    if (const auto study = m_awaited.readyForBeside(); study && openHere(*study))
        m_awaited.forgetBeside();
}

bool ServerCommands::openHere(const StudyFacts &wanted) {
    // Servers may spell the name differently: the UID identifies it.
    const auto here = m_bench.library.find(wanted.patientId, StudyOrder::newestFirst, 0, 500);
    const auto study = std::find_if(here.studies.begin(), here.studies.end(),
                                    [&](const StudyFacts &one) { return one.uid == wanted.uid; });
    if (study == here.studies.end())
        return false;
    const Document &document = m_bench.study.document;
    const QString modality =
        document.currentSource() < 0
            ? QString()
            : document.sources()[std::size_t(document.currentSource())].volume.modality;
    // The largest one, of the same modality if there is one.
    const auto rank = [&](const VolumeFacts &volume) {
        return std::tuple(volume.placed, volume.modality == modality, volume.size.count());
    };
    const std::vector<VolumeFacts> volumes = m_bench.library.volumes(*study);
    const auto best = std::max_element(
        volumes.begin(), volumes.end(),
        [&](const VolumeFacts &a, const VolumeFacts &b) { return rank(a) < rank(b); });
    if (best == volumes.end() || !best->placed) {
        m_bench.notices.say(tr("This study has no volume"));
        return true;
    }
    const auto open =
        [this, source = librarySource(*study, *best, m_bench.library.files(*study, *best))] {
            m_pair.openBeside(source);
        };
    const archive::Patient listed = patientOf(wanted), named = patientOf(*study);
    if (archive::isOfAnother(listed, named))
        askForAnotherPatient(listed, named, open);
    else
        open();
    return true;
}

void ServerCommands::showServers() {
    showOnly<ServersDialog>(m_window, [this] {
        return new ServersDialog(m_bench.servers, m_bench.receiver, &m_window);
    });
}

void ServerCommands::open(const OpenRequest &request) {
    const auto &servers = m_bench.servers.servers();
    const auto server = std::find_if(servers.begin(), servers.end(), [&](const auto &one) {
        return QString::fromStdString(one.name) == request.server;
    });
    if (server == servers.end()) {
        m_bench.notices.report(task::because::thereIsNoServer(request.server.toStdString()), {});
        return;
    }
    // With its address: another server of the same name is asked about again.
    const QString allowed =
        request.server + "\n" + QString::fromStdString(archive::addressOf(server->peer));
    if (QSettings().value(allowedKey).toStringList().contains(allowed)) {
        find(request);
        return;
    }
    ask(&m_window,
        {"linkQuestion", tr("Open a link"),
         tr("Another program asks to open a study from the server %1. Allow links to this server?")
             .arg(request.server),
         tr("Allow")},
        [this, request, allowed] {
            QSettings settings;
            settings.setValue(allowedKey, settings.value(allowedKey).toStringList() << allowed);
            find(request);
        });
}

// Asks the server for the study's facts, which its list and its heading show while it arrives.
void ServerCommands::find(const OpenRequest &request) {
    m_bench.servers.withSecrets(
        {request.server}, &m_window,
        [self = QPointer<ServerCommands>(this), this,
         request](const std::vector<archive::Server> &servers) {
            if (self == nullptr || servers.empty())
                return;
            m_finding.start(
                tr("Looking for a study"),
                [this, servers, request](const Job &job) {
                    archive::SearchTerms terms;
                    terms.studyUid = request.studyUid.toStdString();
                    const auto result = archive::search(servers, terms, {}, job.progress());
                    const archive::ServerOutcome &outcome = result.outcomes.front();
                    if (outcome.failure)
                        throw task::Error(outcome.code, *outcome.failure, outcome.server);
                    if (result.entries.empty())
                        throw task::Error(task::ErrorCode::unusable,
                                          task::because::serverHasNoSuchStudy, outcome.server);
                    job.deliver(
                        [this, study = remoteStudy(result.entries.front())] { retrieve(study); });
                },
                [this, request](const Outcome &outcome) {
                    if (outcome.kind == Outcome::Kind::failed)
                        m_bench.notices.report(*outcome.reason, request.server);
                });
        });
}

void ServerCommands::send(const QStringList &files, const QString &server) {
    if (files.isEmpty()) {
        m_bench.notices.say(tr("There are no files to send"));
        return;
    }
    if (m_bench.exports.isRunning()) { // another job would cancel it
        m_bench.notices.say(tr("Another export is running"));
        return;
    }
    m_bench.servers.withSecrets(
        {server}, &m_window,
        [self = QPointer<ServerCommands>(this), this,
         files](const std::vector<archive::Server> &servers) {
            // Meanwhile the window may have been closed, or another export started.
            if (self == nullptr || servers.empty() || m_bench.exports.isRunning())
                return;
            std::vector<std::filesystem::path> paths;
            for (const QString &file : files)
                paths.emplace_back(file.toStdString());
            const QString name = QString::fromStdString(servers.front().name);
            m_bench.exports.start(
                tr("Sending to %1").arg(name),
                [this, paths, target = servers.front(), name](const Job &job) {
                    const auto report = archive::send(target, paths, {}, job.progress());
                    job.deliver([this, report, name] {
                        for (const auto *const left : {&report.notSent, &report.withChanges})
                            for (const dicom::Skipped &file : *left)
                                m_bench.notices.report(file.reason,
                                                       QString::fromStdString(file.path.string()));
                        m_bench.notices.say(tr("%1 of %2 sent to %3")
                                                .arg(QString::number(report.state.sent),
                                                     QString::number(report.state.files), name));
                    });
                },
                [this, name](const Outcome &outcome) {
                    if (outcome.kind == Outcome::Kind::failed)
                        m_bench.notices.report(*outcome.reason, name);
                });
        });
}

} // namespace pellucid::ui
