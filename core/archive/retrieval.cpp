// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/retrieval.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "core/archive/listener.h"
#include "core/exchange/link.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using exchange::Level;
using exchange::Purpose;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::uint16_t outOfResources = 0xa700, notWanted = 0x0124, notAsAnnounced = 0xa900;
constexpr std::size_t leastOfABatch = 8, mostOfABatch = 32;
constexpr std::size_t mostUnwanted = 1000;
// Connections that are lost one after the other, without any object between.
constexpr int maxFailures = 3, maxRefusals = 3;
constexpr std::chrono::milliseconds pauses[maxFailures]{std::chrono::milliseconds(300),
                                                        std::chrono::milliseconds(1500),
                                                        std::chrono::milliseconds(4000)};

// Instances of one series that are asked for together.
struct Batch {
    std::string studyUid, seriesUid;
    std::vector<std::string> uids;
};

// What all connections share.
class Work {
public:
    Work(const std::vector<Instance> &instances, const ObjectFolder &folder,
         const RetrievalObserver &observer, int connections)
        : m_folder(folder), m_observer(observer), m_connections(std::size_t(connections)) {
        m_state.wanted = instances.size();
        for (const Instance &instance : instances) {
            if (folder.has(instance.studyUid, instance.seriesUid, instance.sopInstanceUid))
                ++m_state.present;
            else
                m_missing.emplace(instance.sopInstanceUid, instance);
        }
        fillQueue(instances);
    }

    std::size_t missing() const { return m_missing.size(); }
    std::set<std::string> classes() const {
        std::set<std::string> found;
        for (const auto &[uid, instance] : m_missing)
            found.insert(instance.sopClassUid);
        return found;
    }

    // The next batch; nothing when all are taken.
    std::optional<Batch> next() {
        const std::lock_guard lock(m_mutex);
        if (m_queue.empty() || m_failure || m_offersNoGet)
            return std::nullopt;
        Batch batch = std::move(m_queue.front());
        m_queue.pop_front();
        return batch;
    }

    // After a lost connection: what has not come is asked for again.
    void putBack(Batch batch) {
        const std::lock_guard lock(m_mutex);
        std::erase_if(batch.uids, [&](const std::string &uid) { return !m_missing.contains(uid); });
        if (!batch.uids.empty())
            m_queue.push_front(std::move(batch));
    }

    // Where an awaited object belongs; nothing if it is not awaited. *Throws* if the server goes on
    // and on with others.
    std::optional<ObjectFolder::Place> placeOf(const std::string &uid) {
        const std::lock_guard lock(m_mutex);
        const auto missing = m_missing.find(uid);
        if (missing != m_missing.end())
            return ObjectFolder::Place{missing->second.studyUid, missing->second.seriesUid};
        if (++m_unwanted > mostUnwanted + m_state.wanted)
            throw Error(ErrorCode::unusable, because::serverSendsTooMuch);
        return std::nullopt;
    }
    void stored(const StoredObject &object) {
        const std::lock_guard lock(m_mutex);
        if (m_missing.erase(object.sopInstanceUid) == 0)
            return;
        m_reasons.erase(object.sopInstanceUid);
        ++m_state.received;
        if (m_observer.stored)
            m_observer.stored(object);
        if (m_observer.changed)
            m_observer.changed(m_state);
    }
    void refused(const std::string &uid, const task::Reason &reason) {
        const std::lock_guard lock(m_mutex);
        m_reasons.insert_or_assign(uid, reason);
    }
    // The server ended a batch: what did not come has this reason unless it has its own.
    void ended(const Batch &batch, const exchange::RetrievalEnd &end) {
        const std::lock_guard lock(m_mutex);
        for (const std::string &uid : batch.uids)
            if (m_missing.contains(uid) && !m_reasons.contains(uid))
                m_reasons.emplace(
                    uid, !end.reason.empty()
                             ? task::Reason::decoded(end.reason).value_or(because::serverLeftItOut)
                         : std::find(end.failedInstances.begin(), end.failedInstances.end(), uid) !=
                                 end.failedInstances.end()
                             ? task::Reason(because::serverCouldNotSendIt)
                             : task::Reason(because::serverLeftItOut));
    }
    void failed(const Batch &batch, const task::Reason &reason) {
        const std::lock_guard lock(m_mutex);
        for (const std::string &uid : batch.uids)
            if (m_missing.contains(uid))
                m_reasons.insert_or_assign(uid, reason);
    }
    void moved(std::int64_t bytes) {
        const std::lock_guard lock(m_mutex);
        m_state.bytes = std::uint64_t(std::int64_t(m_state.bytes) + bytes);
        if (m_observer.changed)
            m_observer.changed(m_state);
    }
    // The number of batches that were refused without any object between.
    int refusedAgain() {
        const std::lock_guard lock(m_mutex);
        if (m_state.received != m_receivedAtRefusal)
            m_refusals = 0;
        m_receivedAtRefusal = m_state.received;
        return ++m_refusals;
    }
    // The rest is not asked for.
    void refuseAll(const Batch &batch, const task::Reason &reason) {
        failed(batch, reason);
        const std::lock_guard lock(m_mutex);
        for (const Batch &waiting : m_queue)
            for (const std::string &uid : waiting.uids)
                m_reasons.insert_or_assign(uid, reason);
        m_queue.clear();
    }
    void offersNoGet() {
        const std::lock_guard lock(m_mutex);
        m_offersNoGet = true;
    }
    bool needsMove() const { return m_offersNoGet; }
    void useMove() { m_offersNoGet = false; }
    // Ends all connections: the disk is full, or the program is to stop.
    void stop(std::exception_ptr failure) {
        const std::lock_guard lock(m_mutex);
        if (!m_failure)
            m_failure = std::move(failure);
    }
    void rethrow() {
        if (m_failure)
            std::rethrow_exception(m_failure);
    }
    std::size_t receivedCount() {
        const std::lock_guard lock(m_mutex);
        return m_state.received;
    }

    // Asks once more for what the server refused. False if it refused nothing.
    bool fillQueueAgain(const std::vector<Instance> &instances) {
        const std::lock_guard lock(m_mutex);
        const bool isRefused =
            std::any_of(m_reasons.begin(), m_reasons.end(), [](const auto &reason) {
                return reason.second.is(because::serverStatus) ||
                       reason.second.is(because::serverStatusWithComment) ||
                       reason.second.is(because::serverCouldNotSendIt);
            });
        if (!isRefused || m_missing.empty())
            return false;
        m_refusals = 0;
        fillQueue(instances);
        return true;
    }

    RetrievalReport report() {
        const std::lock_guard lock(m_mutex);
        RetrievalReport report{m_state, 0.0, {}, m_unwanted};
        for (const auto &[uid, instance] : m_missing) {
            const auto reason = m_reasons.find(uid);
            report.lacking.push_back(
                {uid, reason == m_reasons.end() ? because::serverLeftItOut : reason->second});
        }
        return report;
    }
    const ObjectFolder &folder() const { return m_folder; }

private:
    void fillQueue(const std::vector<Instance> &instances) {
        for (std::size_t begin = 0; begin < instances.size();) {
            std::size_t end = begin;
            while (end < instances.size() && instances[end].seriesUid == instances[begin].seriesUid)
                ++end;
            const std::size_t count = end - begin;
            const std::size_t largest = std::clamp(count / 16, leastOfABatch, mostOfABatch);
            // Dealt out among the connections: together they bring coarse slices before fine ones.
            const Batch empty{instances[begin].studyUid, instances[begin].seriesUid, {}};
            std::vector<Batch> hands(m_connections, empty);
            std::size_t dealt = 0, taken = 0;
            const auto flush = [&] {
                for (Batch &hand : hands)
                    if (!hand.uids.empty())
                        m_queue.push_back(std::exchange(hand, empty));
                dealt = 0;
            };
            for (const std::size_t index : coarseToFine(count)) {
                const std::string &uid = instances[begin + index].sopInstanceUid;
                if (!m_missing.contains(uid))
                    continue;
                hands[dealt++ % hands.size()].uids.push_back(uid);
                // Small ones first: what is shown is coarse at first, and must not wait.
                const std::size_t size = ++taken <= count / 8 + 2 ? leastOfABatch : largest;
                if (dealt >= size * hands.size())
                    flush();
            }
            flush();
            begin = end;
        }
    }

    const ObjectFolder &m_folder;
    const RetrievalObserver &m_observer;
    const std::size_t m_connections;
    std::mutex m_mutex;
    std::map<std::string, Instance> m_missing;
    std::map<std::string, task::Reason> m_reasons;
    std::deque<Batch> m_queue;
    RetrievalState m_state;
    std::size_t m_unwanted = 0;
    int m_refusals = 0;
    std::size_t m_receivedAtRefusal = 0;
    bool m_offersNoGet = false;
    std::exception_ptr m_failure;
};

// The objects of one connection.
class Objects : public exchange::Receiver {
public:
    explicit Objects(Work &work) : m_work(work) {}

    std::variant<int, std::uint16_t> open(const exchange::Arrival &arrival) override {
        m_reported = 0;
        m_place = m_work.placeOf(arrival.sopInstanceUid);
        if (!m_place)
            return notWanted;
        m_file = m_work.folder().open(arrival);
        return m_file->descriptor();
    }
    std::uint16_t keep(const exchange::Arrival &arrival, std::uint64_t bytes) override {
        receive(bytes);
        const std::unique_ptr<files::AtomicFile> file = std::move(m_file);
        try {
            m_work.stored(m_work.folder().keep(*file, arrival, bytes, m_place));
            return 0;
        } catch (const Error &error) {
            if (error.code() == ErrorCode::output) {
                m_work.stop(std::current_exception()); // also if a listener's thread brings it
                throw;
            }
            m_work.refused(arrival.sopInstanceUid, error.reason());
            return notAsAnnounced;
        }
    }
    void receive(std::uint64_t bytes) override {
        m_work.moved(std::int64_t(bytes) - std::int64_t(m_reported));
        m_reported = bytes;
    }

private:
    Work &m_work;
    std::unique_ptr<files::AtomicFile> m_file;
    std::optional<ObjectFolder::Place> m_place;
    std::uint64_t m_reported = 0;
};

// One connection after the other, until no batch is left.
class Worker {
public:
    Worker(const Server &server, Purpose purpose, std::vector<std::string> classes,
           std::vector<std::string> syntaxes, std::string destinationAe, Work &work,
           const task::Progress &progress)
        : m_work(work), m_progress(progress),
          m_objects(work), m_connection{server.peer, purpose, std::move(classes),
                                        std::move(syntaxes)},
          m_destinationAe(std::move(destinationAe)),
          m_mayMove(purpose == Purpose::get && server.retrieve == RetrieveMethod::automatic) {}

    void run() {
        try {
            takeAll();
        } catch (...) {
            m_work.stop(std::current_exception());
        }
        // At once: some servers keep others waiting while an association is open.
        m_link.reset();
    }
    const std::optional<Error> &failure() const { return m_failure; }

private:
    void takeAll() {
        for (int failures = 0;;) {
            std::optional<Batch> batch = m_work.next();
            if (!batch)
                return;
            const std::size_t before = m_work.receivedCount();
            try {
                take(*batch);
                failures = 0;
            } catch (const Error &error) {
                if (error.code() != ErrorCode::unreachable)
                    throw;
                m_link.reset();
                failures = m_work.receivedCount() > before ? 0 : failures + 1;
                if (failures >= maxFailures) {
                    m_work.failed(*batch, error.reason());
                    // Others may still be connected.
                    m_work.putBack(std::move(*batch));
                    m_failure = error;
                    return;
                }
                m_work.putBack(std::move(*batch));
                pause(pauses[failures]);
            }
        }
    }
    void take(const Batch &batch) {
        try {
            if (!m_link)
                m_link.emplace(m_connection, m_progress);
            const exchange::RetrievalEnd end = m_link->retrieve({.level = Level::image,
                                                                 .studyUid = batch.studyUid,
                                                                 .seriesUid = batch.seriesUid,
                                                                 .instanceUids = batch.uids,
                                                                 .destinationAe = m_destinationAe},
                                                                m_objects, m_progress);
            m_work.ended(batch, end);
        } catch (const Error &error) {
            if (error.code() != ErrorCode::unusable)
                throw;
            if (m_mayMove && error.reason().is(because::serverLacksTheService)) {
                m_work.putBack(batch);
                m_work.offersNoGet();
                return;
            }
            m_link.reset();
            // What is refused again and again would be refused to the end.
            if (m_work.refusedAgain() >= maxRefusals)
                m_work.refuseAll(batch, error.reason());
            else
                m_work.failed(batch, error.reason());
        }
    }
    void pause(std::chrono::milliseconds duration) const {
        const auto end = Clock::now() + duration;
        while (Clock::now() < end) {
            m_progress.check();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    Work &m_work;
    const task::Progress &m_progress;
    Objects m_objects;
    exchange::Connection m_connection;
    std::string m_destinationAe;
    bool m_mayMove;
    std::optional<exchange::Link> m_link;
    std::optional<Error> m_failure;
};

// Runs workers until no batch is left. *Throws* what stops them all, or the failure of all of them
// if nothing has come.
void runWorkers(const Server &server, Purpose purpose, const std::vector<std::string> &classes,
                const std::vector<std::string> &syntaxes, const std::string &destinationAe,
                Work &work, const task::Progress &progress) {
    // A connection costs round trips, which a few objects do not repay.
    const std::size_t useful = (work.missing() + leastOfABatch - 1) / leastOfABatch;
    const std::size_t count = std::min<std::size_t>(useful, std::size_t(server.connections));
    std::vector<std::unique_ptr<Worker>> workers;
    for (std::size_t n = 0; n < count; ++n)
        workers.push_back(std::make_unique<Worker>(server, purpose, classes, syntaxes,
                                                   destinationAe, work, progress));
    {
        std::vector<std::jthread> threads;
        for (std::size_t n = 1; n < workers.size(); ++n)
            threads.emplace_back([worker = workers[n].get()] { worker->run(); });
        if (!workers.empty())
            workers.front()->run();
    }
    work.rethrow();
    if (work.receivedCount() == 0 && work.missing() > 0)
        for (const auto &worker : workers)
            if (worker->failure())
                throw *worker->failure();
}

} // namespace

RetrievalReport retrieve(const Server &server, const Wanted &wanted, const ObjectFolder &folder,
                         const RetrievalObserver &observer, const task::Progress &progress,
                         const MoveDestination &destination) {
    const auto begin = Clock::now();
    const std::vector<Instance> instances = listInstances(server, wanted, progress);
    if (observer.listed)
        observer.listed(instances);
    std::error_code failed;
    std::filesystem::create_directories(folder.folder(), failed);
    if (failed)
        throw Error(ErrorCode::output, because::cannotBeMade(task::systemReason(failed.value())),
                    folder.folder());
    Work work(instances, folder, observer, server.connections);
    // Every connection proposes the kinds that lack; a server that does not tell them gets the
    // common ones.
    std::set<std::string> classes = work.classes();
    if (classes.contains(""))
        classes.clear();
    if (server.retrieve != RetrieveMethod::move)
        runWorkers(server, Purpose::get, {classes.begin(), classes.end()}, {}, {}, work, progress);
    const bool hasMoved = server.retrieve == RetrieveMethod::move || work.needsMove();
    if (hasMoved) {
        work.useMove();
        ListenerOptions options;
        options.port = destination.port;
        options.ae = destination.ae.empty() ? server.peer.callingAe : destination.ae;
        // What is asked for with TLS does not come without.
        options.usesTls = server.peer.usesTls;
        if (options.usesTls && server.peer.certificate.empty())
            throw Error(ErrorCode::unusable, because::receivingNeedsACertificate);
        options.certificate = server.peer.certificate;
        options.key = server.peer.key;
        options.keyPassword = server.peer.keyPassword;
        options.authorities = server.peer.authorities;
        options.senders = {{"", server.peer.host}};
        options.silenceSeconds = server.peer.silenceSeconds;
        const Listener listener(options, [&] { return std::make_unique<Objects>(work); });
        runWorkers(server, Purpose::move, {}, {}, options.ae, work, progress);
    }
    // Some servers take the first presentation context of a kind, whatever they have stored, and
    // then cannot send it: one encoding at a time, until all is here.
    if (server.retrieve != RetrieveMethod::move && !hasMoved &&
        server.peer.protocol == exchange::Protocol::dicom)
        for (const std::string &syntax : exchange::transferSyntaxes())
            if (work.fillQueueAgain(instances))
                runWorkers(server, Purpose::get, {classes.begin(), classes.end()}, {syntax}, {},
                           work, progress);
    RetrievalReport report = work.report();
    if (report.state.received > 0)
        files::flush(folder.folder());
    report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return report;
}

} // namespace pellucid::archive
