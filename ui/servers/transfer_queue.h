// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <vector>

#include <QDateTime>
#include <QHash>
#include <QObject>
#include <QPair>
#include <QPointer>
#include <QSet>
#include <QTimer>

#include "core/archive/run_transfer.h"
#include "core/dicom/arriving_series.h"
#include "ui/jobs/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/servers/remote_study.h"
#include "ui/servers/server_book.h"
#include "ui/servers/study_receiver.h"

namespace pellucid::ui {

/// The files that came into the library's folder and that the library does not list yet; none if
/// the log of transfers cannot be read, which `TransferQueue` reports.
std::vector<std::filesystem::path> unlistedFiles();

/// Retrieves studies from servers into the library, one after the other, each over several
/// connections. The queue is on disk: a program that starts continues what another one left. What
/// arrives is listed in the library.
class TransferQueue : public QObject {
    Q_OBJECT
public:
    TransferQueue(ServerBook &book, StudyLibrary &library, StudyReceiver &receiver,
                  QObject *parent = nullptr);
    ~TransferQueue() override;

    /// Continues transfers that were interrupted, and lists what arrived meanwhile. `asking`: the
    /// window that asks for missing secrets.
    void resume(QWidget *asking);
    /// `later`: it waits for all others, and makes way for them.
    enum class Urgency { now, later };
    void add(const RemoteStudy &study, QWidget *asking, Urgency urgency = Urgency::now);
    void retry(qint64 id, QWidget *asking);
    /// Retrieves objects of a study again of which the server lists corrected data.
    void replace(const QString &studyUid, QWidget *asking);
    void cancel(qint64 id);
    void clearFinished();

    const std::vector<archive::Transfer> &transfers() const { return m_transfers; }
    bool isRunning() const { return m_jobs.isRunning(); }

signals:
    void changed();
    /// The largest series of a study begins to arrive.
    void arriving(const QString &studyUid, const std::shared_ptr<dicom::ArrivingSeries> &series);
    /// All of a study is here, perhaps with images of a patient who is not the one listed.
    /// `isAwaited`: a user asked for it.
    void completed(const QString &folder, bool isAwaited,
                   const pellucid::archive::RetrievalReport &report);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void read();
    void startNext(QWidget *asking);
    bool isForLater(qint64 id) const;
    void run(const archive::Transfer &transfer, const archive::Server &server);
    void listArrivals();
    /// Notices what other programs retrieve and receive, such as the command line.
    void lookAtLog();
    template <class F> void attempt(const F &what);

    ServerBook &m_book;
    StudyLibrary &m_library;
    StudyReceiver &m_receiver;
    std::vector<archive::Transfer> m_transfers;
    /// The running one, whose state is newer than on disk.
    qint64 m_running = 0;
    /// Those that another program works on.
    std::set<qint64> m_elsewhere;
    bool m_isWaitingForSecrets = false;
    QTimer m_look;
    QPair<QDateTime, QDateTime> m_logTimes; ///< when the log was last written
    std::size_t m_arrivalsSeen = 0;
    QHash<QString, archive::Patient> m_listed; ///< with which patient a study was asked for, by UID
    QSet<QString> m_replaced;                  ///< studies that are retrieved again, by UID
    QPointer<QWidget> m_asking;                ///< windows come and go
    JobRunner m_jobs;
};

} // namespace pellucid::ui
