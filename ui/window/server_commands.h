// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QObject>
#include <QStringList>

#include "core/task/reason.h"
#include "ui/servers/remote_study.h"

class QMainWindow;

namespace pellucid::ui {

struct Workbench;
class StudyDocks;

/// The commands that concern servers: the dialog, retrieving, sending, and what happens when a
/// study has arrived.
class ServerCommands : public QObject {
    Q_OBJECT
public:
    ServerCommands(QMainWindow &window, Workbench &bench, StudyDocks &docks);

    void showServers();

signals:
    /// A study is here, and wanted in the panes.
    void studyArrived(const QString &folder);
    void messageShown(const QString &text);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void send(const QStringList &files, const QString &server);

    QMainWindow &m_window;
    Workbench &m_bench;
    /// The study that was asked for last, unless another one has been opened since.
    std::optional<RemoteStudy> m_awaited;
    /// The study that was opened last while it arrived: it is not opened again at its end.
    QString m_seen;
};

} // namespace pellucid::ui
