// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
#include <vector>

#include <QHash>
#include <QObject>

#include "core/archive/run_transfer.h"
#include "core/dicom/arriving_series.h"
#include "ui/jobs/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/servers/remote_study.h"
#include "ui/servers/server_book.h"

namespace pellucid::ui {

/// Retrieves studies from servers into the library, one after the other, each over several
/// connections. The queue is on disk: a program that starts continues what another one left. What
/// arrives is listed in the library.
class TransferQueue : public QObject {
    Q_OBJECT
public:
    TransferQueue(ServerBook &book, StudyLibrary &library, QObject *parent = nullptr);
    ~TransferQueue() override;

    /// Continues transfers that were interrupted, and lists what arrived meanwhile. `asking`: the
    /// window that asks for missing secrets.
    void resume(QWidget *asking);
    void add(const RemoteStudy &study, QWidget *asking);
    void retry(qint64 id, QWidget *asking);
    void cancel(qint64 id);
    void clearFinished();

    const std::vector<archive::Transfer> &transfers() const { return m_transfers; }
    bool isRunning() const { return m_jobs.isRunning(); }

signals:
    void changed();
    /// The largest series of a study begins to arrive.
    void arriving(const QString &studyUid, const std::shared_ptr<dicom::ArrivingSeries> &series);
    /// All of a study is here.
    void completed(const QString &folder);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void read();
    void startNext(QWidget *asking);
    void run(const archive::Transfer &transfer, const archive::Server &server);
    void listArrivals();
    template <class F> void attempt(const F &what);

    ServerBook &m_book;
    StudyLibrary &m_library;
    std::vector<archive::Transfer> m_transfers;
    /// The running one, whose state is newer than on disk.
    qint64 m_running = 0;
    /// Those that another program works on.
    std::set<qint64> m_elsewhere;
    bool m_isWaitingForSecrets = false;
    QWidget *m_asking = nullptr;
    JobRunner m_jobs;
};

} // namespace pellucid::ui
