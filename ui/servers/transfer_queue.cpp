// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/servers/transfer_queue.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <utility>

#include <QFileInfo>
#include <QWidget>

#include "core/files/user_folders.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::ui {

namespace {

using archive::Transfer;
using archive::TransferLog;
using archive::TransferState;

constexpr auto lookEvery = std::chrono::seconds(3);

// Without one, nothing has ever been retrieved; looking does not make it.
bool hasLog() {
    std::error_code unknown;
    return files::userDataFolder() && std::filesystem::exists(TransferLog::fileOfUser(), unknown);
}

// The series of a transfer that is shown while it arrives, as objects are announced one at a time.
class SeriesToShow {
public:
    ~SeriesToShow() {
        if (m_series)
            m_series->end();
    }

    /// Null if the server lists no objects. *Requires*: the largest series comes first.
    std::shared_ptr<dicom::ArrivingSeries> begin(const archive::Listing &listing) {
        if (listing.instances.empty())
            return nullptr;
        m_uid = listing.instances.front().seriesUid;
        for (const archive::Instance &instance : listing.instances)
            if (instance.seriesUid == m_uid)
                m_numbers.emplace(instance.sopInstanceUid, m_numbers.size());
        std::size_t unlisted = 0;
        bool mayHaveMore = false;
        for (const archive::ShortSeries &series : listing.shortSeries)
            if (series.seriesUid == m_uid || series.seriesUid.empty()) {
                unlisted += series.seriesUid.empty() ? 0 : series.unlisted;
                mayHaveMore = mayHaveMore || series.mayHaveMore || series.seriesUid.empty();
            }
        m_series = std::make_shared<dicom::ArrivingSeries>(m_numbers.size(), unlisted, mayHaveMore);
        return m_series;
    }
    void add(const archive::StoredObject &object) {
        if (!m_series || object.seriesUid != m_uid)
            return;
        const auto number = m_numbers.find(object.sopInstanceUid);
        if (number != m_numbers.end())
            m_series->add(number->second, object.path);
        else
            m_series->addUnlisted(object.path);
    }

private:
    std::string m_uid;
    std::map<std::string, std::size_t> m_numbers;
    std::shared_ptr<dicom::ArrivingSeries> m_series;
};

} // namespace

std::vector<std::filesystem::path> unlistedFiles() {
    std::vector<std::filesystem::path> files;
    try {
        if (hasLog())
            for (const archive::StoredObject &object :
                 TransferLog(TransferLog::fileOfUser()).arrivals())
                files.push_back(object.path);
    } catch (const task::Error &) {
        // The queue reads it, too.
    }
    return files;
}

TransferQueue::TransferQueue(ServerBook &book, StudyLibrary &library, StudyReceiver &receiver,
                             QObject *parent)
    : QObject(parent), m_book(book), m_library(library), m_receiver(receiver) {
    connect(&receiver, &StudyReceiver::arrived, this, &TransferQueue::listArrivals);
    attempt([this] { read(); });
    m_look.setInterval(lookEvery);
    connect(&m_look, &QTimer::timeout, this, &TransferQueue::lookAtLog);
    m_look.start();
}

TransferQueue::~TransferQueue() = default;

template <class F> void TransferQueue::attempt(const F &what) {
    try {
        what();
    } catch (const task::Error &error) {
        emit failed(error.reason(), QString::fromStdString(error.path().string()));
    }
}

void TransferQueue::read() {
    if (hasLog())
        m_transfers = TransferLog(TransferLog::fileOfUser()).transfers();
    emit changed();
}

void TransferQueue::resume(QWidget *asking) {
    attempt([this] {
        if (hasLog() && !TransferLog(TransferLog::fileOfUser()).arrivals().empty())
            listArrivals();
    });
    startNext(asking);
}

void TransferQueue::add(const RemoteStudy &study, QWidget *asking, Urgency urgency) {
    attempt([&] {
        Transfer transfer;
        transfer.server = study.servers.value(0).toStdString();
        transfer.wanted.studyUid = study.study.uid.toStdString();
        transfer.title = studyText(study.study).toStdString();
        transfer.folder = archive::libraryObjectFolder();
        transfer.isForLater = urgency == Urgency::later;
        m_listed[study.study.uid] = patientOf(study.study);
        const qint64 id = TransferLog(TransferLog::fileOfUser()).add(transfer);
        m_elsewhere.erase(id);
        read();
        // The running one waits again, and goes on where it was.
        if (urgency == Urgency::now && m_running != id && isForLater(m_running))
            m_jobs.cancel();
    });
    startNext(asking);
}

void TransferQueue::retry(qint64 id, QWidget *asking) {
    attempt([&] {
        TransferLog(TransferLog::fileOfUser()).retry(id);
        m_elsewhere.erase(id);
        read();
    });
    startNext(asking);
}

void TransferQueue::replace(const QString &studyUid, QWidget *asking) {
    const auto known =
        std::find_if(m_transfers.rbegin(), m_transfers.rend(), [&](const Transfer &one) {
            return one.wanted.studyUid == studyUid.toStdString() &&
                   one.folder == archive::libraryObjectFolder();
        });
    if (known == m_transfers.rend())
        return;
    m_replaced.insert(studyUid);
    retry(known->id, asking);
}

void TransferQueue::cancel(qint64 id) {
    attempt([&] {
        TransferLog(TransferLog::fileOfUser()).cancel(id);
        if (id == m_running)
            m_jobs.cancel();
        read();
    });
}

void TransferQueue::clearFinished() {
    attempt([this] {
        TransferLog(TransferLog::fileOfUser()).clearFinished();
        read();
    });
}

// It may have become urgent since it began.
bool TransferQueue::isForLater(qint64 id) const {
    return std::any_of(m_transfers.begin(), m_transfers.end(),
                       [&](const Transfer &one) { return one.id == id && one.isForLater; });
}

void TransferQueue::startNext(QWidget *asking) {
    if (asking != nullptr)
        m_asking = asking;
    if (m_jobs.isRunning() || m_isWaitingForSecrets)
        return;
    // Another program's running transfer is refused when it is claimed, and left to it.
    if (m_transfers.empty())
        return;
    const auto waits = [this](const Transfer &transfer) {
        return transfer.state <= TransferState::running && !m_elsewhere.contains(transfer.id) &&
               transfer.folder == archive::libraryObjectFolder();
    };
    auto next = std::find_if(m_transfers.begin(), m_transfers.end(), [&](const Transfer &transfer) {
        return waits(transfer) && !transfer.isForLater;
    });
    if (next == m_transfers.end())
        next = std::find_if(m_transfers.begin(), m_transfers.end(), waits);
    if (next == m_transfers.end())
        return;
    m_isWaitingForSecrets = true;
    // Nobody is asked for a password because of a study that may be wanted later.
    QWidget *const asked = next->isForLater ? nullptr : m_asking.data();
    m_book.withSecrets({QString::fromStdString(next->server)}, asked,
                       [this, transfer = *next](const std::vector<archive::Server> &servers) {
                           m_isWaitingForSecrets = false;
                           if (!servers.empty()) {
                               run(transfer, servers.front());
                               return;
                           }
                           m_replaced.remove(QString::fromStdString(transfer.wanted.studyUid));
                           // The server has been removed, or its password is not known.
                           attempt([&] {
                               TransferLog(TransferLog::fileOfUser()).cancel(transfer.id);
                               read();
                           });
                           startNext(m_asking);
                       });
}

void TransferQueue::run(const Transfer &transfer, const archive::Server &server) {
    m_running = transfer.id;
    const auto show = [this, transfer](const archive::RetrievalState &state) {
        for (Transfer &one : m_transfers)
            if (one.id == transfer.id) {
                one.state = TransferState::running;
                one.total = state.wanted;
                one.received = state.present + state.received;
                one.bytes = transfer.bytes + state.bytes;
            }
        emit changed();
    };
    const auto report = std::make_shared<archive::RetrievalReport>();
    m_jobs.start(
        tr("Retrieving %1").arg(QString::fromStdString(transfer.title)),
        [this, transfer, server, show, report,
         listed = m_listed.value(QString::fromStdString(transfer.wanted.studyUid)),
         replaces = m_replaced.remove(QString::fromStdString(transfer.wanted.studyUid)),
         destination = m_receiver.destinationFor(server)](const Job &job) {
            archive::RetrievalObserver observer;
            auto shown = std::chrono::steady_clock::now();
            observer.changed = [&](const archive::RetrievalState &state) {
                const auto now = std::chrono::steady_clock::now();
                if (now - shown < std::chrono::milliseconds(100))
                    return;
                shown = now;
                job.deliver([show, state] { show(state); });
            };
            SeriesToShow arrivals;
            std::shared_ptr<dicom::ArrivingSeries> series;
            observer.listed = [&](const archive::Listing &listing) {
                series = arrivals.begin(listing);
            };
            observer.matches = [&](const archive::StoredObject &object) {
                arrivals.add(object);
                if (series) // from the first object on
                    job.deliver(
                        [this, uid = QString::fromStdString(transfer.wanted.studyUid),
                         begun = std::exchange(series, nullptr)] { emit arriving(uid, begun); });
            };
            TransferLog log(TransferLog::fileOfUser());
            *report = archive::runTransfer(
                log, transfer.id, server, observer, job.progress(), destination, listed,
                replaces ? archive::Existing::isReplaced : archive::Existing::stays);
        },
        [this, transfer, report](const Outcome &outcome) {
            m_running = 0;
            attempt([this] { read(); });
            listArrivals();
            const auto ended =
                std::find_if(m_transfers.begin(), m_transfers.end(),
                             [&](const Transfer &one) { return one.id == transfer.id; });
            if (ended != m_transfers.end() && ended->state == TransferState::complete)
                emit completed(
                    QString::fromStdString((transfer.folder / transfer.wanted.studyUid).string()),
                    !isForLater(transfer.id), *report);
            // The user is asked to log in; what has arrived is not asked for again.
            if (outcome.kind == Outcome::Kind::failed && m_asking != nullptr &&
                !isForLater(transfer.id) && outcome.reason->is(task::because::loginHasExpired)) {
                retry(transfer.id, m_asking);
                return;
            }
            if (outcome.kind == Outcome::Kind::failed)
                emit failed(*outcome.reason, QString::fromStdString(transfer.server));
            if (outcome.kind == Outcome::Kind::failed && ended != m_transfers.end() &&
                ended->state <= TransferState::running)
                m_elsewhere.insert(transfer.id);
            startNext(m_asking);
        });
}

void TransferQueue::lookAtLog() {
    attempt([this] {
        if (m_jobs.isRunning() || !hasLog())
            return;
        const QString file = QString::fromStdString(TransferLog::fileOfUser().string());
        const QPair times{QFileInfo(file).lastModified(), QFileInfo(file + "-wal").lastModified()};
        const bool isNew = std::exchange(m_logTimes, times) != times;
        if (isNew)
            read();
        // When nothing more has come for a moment.
        if (!isNew && m_arrivalsSeen == 0)
            return;
        const std::size_t before =
            std::exchange(m_arrivalsSeen, TransferLog(TransferLog::fileOfUser()).arrivals().size());
        if (m_arrivalsSeen > 0 && m_arrivalsSeen == before) {
            m_arrivalsSeen = 0;
            listArrivals();
        }
    });
}

void TransferQueue::listArrivals() {
    attempt([this] {
        TransferLog log(TransferLog::fileOfUser());
        const std::vector<archive::StoredObject> arrivals = log.arrivals();
        if (arrivals.empty())
            return;
        std::set<std::filesystem::path> studies;
        for (const archive::StoredObject &object : arrivals)
            studies.insert(object.path.parent_path().parent_path());
        Import import;
        import.mode = ImportMode::refer; // they are in the library's folder already
        std::error_code unknown;
        for (const auto &study : studies)
            if (std::filesystem::exists(study, unknown))
                import.paths.push_back(study);
        // They are forgotten when they are listed, not before.
        import.listed = [arrivals] {
            TransferLog(TransferLog::fileOfUser()).removeArrivals(arrivals);
        };
        if (!import.paths.empty())
            m_library.import(import);
        else
            import.listed(); // they have been removed since
});
}

} // namespace pellucid::ui
