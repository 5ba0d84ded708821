// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/server_commands.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QMainWindow>
#include <QPointer>

#include "core/archive/sending.h"
#include "ui/panels/study_panel.h"
#include "ui/window/servers_dialog.h"
#include "ui/window/study_docks.h"
#include "ui/window/workbench.h"

namespace pellucid::ui {

ServerCommands::ServerCommands(QMainWindow &window, Workbench &bench, StudyDocks &docks)
    : QObject(&window), m_window(window), m_bench(bench) {
    connect(&docks.studies(), &StudyPanel::retrieveRequested, this,
            [this, &docks](const RemoteStudy &study) {
                docks.transfers().show();
                docks.transfers().raise();
                m_awaited = study;
                m_bench.transfers.add(study, &m_window);
            });
    connect(&bench.study.document, &Document::currentSourceChanged, this,
            [this] { m_awaited.reset(); });
    connect(&bench.transfers, &TransferQueue::arriving, this,
            [this](const QString &uid, const std::shared_ptr<dicom::ArrivingSeries> &series) {
                if (m_awaited && m_awaited->study.uid == uid) {
                    const RemoteStudy study = *m_awaited;
                    m_seen = uid;
                    m_bench.study.opener.openArriving(study.study, series);
                }
            });
    connect(&docks.studies(), &StudyPanel::sendRequested, this, &ServerCommands::send);
    connect(&bench.servers, &ServerBook::failed, this, &ServerCommands::failed);
    connect(&bench.transfers, &TransferQueue::failed, this, &ServerCommands::failed);
    // What was asked for is shown, unless another study is open by then.
    connect(&bench.transfers, &TransferQueue::completed, this, [this](const QString &folder) {
        const bool isIdle =
            m_bench.study.document.currentSource() < 0 && !m_bench.study.jobs.isRunning();
        if (isIdle && QFileInfo(folder).fileName() != m_seen)
            emit studyArrived(folder);
        else
            emit messageShown(tr("A study has arrived"));
    });
    // After the window has connected to the signals.
    QMetaObject::invokeMethod(
        this, [this] { m_bench.transfers.resume(&m_window); }, Qt::QueuedConnection);
}

void ServerCommands::showServers() {
    auto *dialog = m_window.findChild<ServersDialog *>();
    if (dialog == nullptr)
        dialog = new ServersDialog(m_bench.servers, &m_window);
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
}

void ServerCommands::send(const QStringList &files, const QString &server) {
    if (files.isEmpty()) {
        emit messageShown(tr("There are no files to send"));
        return;
    }
    if (m_bench.exports.isRunning()) { // another job would cancel it
        emit messageShown(tr("Another export is running"));
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
                        for (const dicom::Skipped &file : report.notSent)
                            emit failed(file.reason, QString::fromStdString(file.path.string()));
                        emit messageShown(tr("%1 of %2 sent to %3")
                                              .arg(report.state.sent)
                                              .arg(report.state.files)
                                              .arg(name));
                    });
                },
                [this, name](const Outcome &outcome) {
                    if (outcome.kind == Outcome::Kind::failed)
                        emit failed(*outcome.reason, name);
                });
        });
}

} // namespace pellucid::ui
