// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/retrieval.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/archive/listener.h"
#include "core/archive/login.h"
#include "core/archive/reasons.h"
#include "core/archive/retrieval_work.h"
#include "core/dicom/missing_objects.h"
#include "core/files/user_folders.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using network::Level;
using network::Purpose;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::size_t firstSlices = 2; // at both ends
// Connections that are lost one after the other, without any object between.
constexpr int maxFailures = 3;
constexpr std::chrono::milliseconds pauses[maxFailures]{std::chrono::milliseconds(300),
                                                        std::chrono::milliseconds(1500),
                                                        std::chrono::milliseconds(4000)};

// The objects of one connection.
class Objects : public network::Receiver {
public:
    Objects(RetrievalWork &work, Existing existing) : m_work(work), m_existing(existing) {}

    /// The server is asked for objects.
    void await() { m_since = Clock::now(); }

    std::variant<platform::HandleView, std::uint16_t>
    open(const network::Arrival &arrival) override {
        m_reported = 0;
        m_begun = Clock::now();
        m_places = m_work.placesOf(arrival.sopInstanceUid);
        if (m_places.empty())
            return network::status::notWanted;
        m_file = m_work.folder().open(arrival);
        return m_file->view();
    }
    std::uint16_t keep(const network::Arrival &arrival, std::uint64_t bytes) override {
        receive(bytes);
        const std::unique_ptr<files::AtomicFile> file = std::move(m_file);
        try {
            const StoredObject object =
                m_work.folder().keep(*file, arrival, bytes, m_places, m_existing);
            const auto waited = std::exchange(m_since, Clock::now());
            m_work.worked(std::chrono::duration<double>(m_begun - waited).count(),
                          std::chrono::duration<double>(m_since - m_begun).count());
            m_work.stored(object);
            return 0;
        } catch (const Error &error) {
            if (error.code() == ErrorCode::output) {
                m_work.stop(std::current_exception()); // also if a listener's thread brings it
                throw;
            }
            m_work.refused(arrival.sopInstanceUid, error.reason());
            return network::status::notAsAnnounced;
        }
    }
    void receive(std::uint64_t bytes) override {
        m_work.moved(std::int64_t(bytes) - std::int64_t(m_reported));
        m_reported = bytes;
    }

private:
    RetrievalWork &m_work;
    Existing m_existing;
    Clock::time_point m_since = Clock::now(), m_begun; // of the pause before the current object
    std::unique_ptr<files::AtomicFile> m_file;
    std::vector<ObjectFolder::Place> m_places; ///< of which the object has to be of one
    std::uint64_t m_reported = 0;
};

// How many associations each server has granted at once, by its address. One that refused more
// is not asked for more for a while.
class Grants {
public:
    int of(const Server &server) {
        const std::lock_guard lock(m_mutex);
        const auto known = m_known.find(addressOf(server.peer));
        return known == m_known.end() || Clock::now() - known->second.since > validity
                   ? server.connections
                   : std::min(server.connections, known->second.count);
    }
    void note(const Server &server, int granted) {
        const std::lock_guard lock(m_mutex);
        m_known[addressOf(server.peer)] = {std::max(1, granted), Clock::now()};
    }

private:
    std::mutex m_mutex;
    // Others use the server as well, and end.
    static constexpr std::chrono::minutes validity{10};
    struct Grant {
        int count;
        Clock::time_point since;
    };
    std::map<std::string, Grant> m_known;
};

Grants &grants() {
    static Grants known;
    return known;
}

bool isFull(const Error &error) {
    return error.reason().is(because::serverHasTooManyConnections) ||
           error.reason().is(because::serverIsBusy);
}

// The server answers a request with a failure.
bool isRefusal(const Error &error) {
    return error.reason().is(because::serverStatus) ||
           error.reason().is(because::serverStatusWithComment);
}

// Connects while the server is still listing its objects, because the slices at both ends are shown
// first. These connections propose the common kinds of objects.
class EarlyLinks {
public:
    EarlyLinks(const Server &server, const task::Progress &progress) {
        if (server.retrieve == RetrieveMethod::move ||
            server.peer.protocol != network::Protocol::dicom)
            return;
        for (int n = 0; n < std::min(int(firstSlices), grants().of(server) - 1); ++n) // one lists
            m_links.push_back(std::async(std::launch::async, [&server, &progress] {
                return std::make_unique<network::Link>(
                    network::Connection{server.peer, Purpose::get}, progress);
            }));
    }
    /// Null if there is none. What has failed is tried again, and then reported.
    std::unique_ptr<network::Link> take() {
        std::unique_ptr<network::Link> link;
        while (!link && !m_links.empty()) {
            try {
                link = m_links.back().get();
            } catch (const std::exception &) {
            }
            m_links.pop_back();
        }
        return link;
    }

private:
    std::vector<std::future<std::unique_ptr<network::Link>>> m_links;
};

bool areCommon(const std::set<std::string> &classes) {
    const auto &common = network::commonClasses();
    return std::all_of(classes.begin(), classes.end(), [&](const std::string &one) {
        return std::find(common.begin(), common.end(), one) != common.end();
    });
}

// One connection after the other, until no batch is left.
class Worker {
public:
    Worker(const Server &server, Purpose purpose, std::vector<std::string> classes,
           std::vector<std::string> syntaxes, std::string destinationAe,
           std::unique_ptr<network::Link> first, Existing existing, std::atomic<int> &open,
           RetrievalWork &work, const task::Progress &progress)
        : m_server(server), m_work(work), m_progress(progress), m_open(open),
          m_link(std::move(first)),
          m_objects(work, existing), m_connection{server.peer, purpose, std::move(classes),
                                                  std::move(syntaxes)},
          m_destinationAe(std::move(destinationAe)),
          m_isAutomatic(server.retrieve == RetrieveMethod::automatic) {
        m_open += m_link ? 1 : 0;
    }

    /// `index`: of this connection. Those for the slices at both ends begin at once, and have the
    /// whole bandwidth; later ones begin if they save time.
    void run(std::size_t index) {
        try {
            if (index < firstSlices || m_work.awaitNeed(index))
                takeAll();
        } catch (...) {
            m_work.stop(std::current_exception());
        }
        // At once: some servers keep others waiting while an association is open.
        disconnect();
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
                disconnect();
                if (isFull(error) && m_open > 0) { // the others are what the server grants
                    grants().note(m_server, m_open);
                    m_work.putBack(std::move(*batch));
                    return;
                }
                m_work.findHere(*batch);
                failures = m_work.receivedCount() > before ? 1 : failures + 1;
                if (failures >= maxFailures) {
                    m_work.failed(*batch, error.reason());
                    m_work.gaveUp(error.reason());
                    // Another connection may succeed.
                    m_work.putBack(std::move(*batch));
                    m_failure = error;
                    return;
                }
                m_work.putBack(std::move(*batch));
                pause(pauses[failures - 1]);
            }
        }
    }
    void connect() {
        if (m_link)
            return;
        m_connection.peer = authenticated(m_server, m_progress,
                                          m_refusedTokens.empty() ? "" : m_refusedTokens.back());
        m_receivedBefore = m_work.receivedBefore(m_connection.peer.secret);
        m_link = std::make_unique<network::Link>(m_connection, m_progress);
        ++m_open;
    }
    void disconnect() {
        m_open -= m_link ? 1 : 0;
        m_link.reset();
    }
    void take(const Batch &batch) {
        try {
            connect();
            m_objects.await();
            const Level level = !batch.uids.empty()       ? Level::image
                                : batch.seriesUid.empty() ? Level::study
                                                          : Level::series;
            const network::RetrievalEnd end = m_link->retrieve({.level = level,
                                                                .studyUid = batch.studyUid,
                                                                .seriesUid = batch.seriesUid,
                                                                .instanceUids = batch.uids,
                                                                .destinationAe = m_destinationAe},
                                                               m_objects, m_progress);
            m_work.findHere(batch); // another listener may have stored them
            m_work.ended(batch, end);
        } catch (const Error &error) {
            if (error.code() != ErrorCode::unusable || error.reason().is(because::loginHasExpired))
                throw;
            if (isTokenRefused(m_server, error) && mayRenew()) {
                m_refusedTokens.push_back(m_connection.peer.secret);
                disconnect();
                m_work.putBack(batch);
                return;
            }
            if (m_isAutomatic && error.reason().is(because::serverLacksTheService)) {
                if (m_connection.purpose == Purpose::move) {
                    m_work.refuseAll(batch, because::serverSendsNothing);
                    return;
                }
                m_work.putBack(batch);
                m_work.offersNoGet();
                return;
            }
            if (isRefusal(error)) {
                m_work.failed(batch, error.reason());
                if (m_work.askDifferently(batch))
                    return;
            }
            disconnect();
            // A login that is refused will be refused again; anything else concerns these objects.
            if (isTokenRefused(m_server, error) || error.reason().is(because::serverDoesNotAllowIt))
                m_work.refuseAll(batch, error.reason());
            else
                m_work.failed(batch, error.reason());
        }
    }
    // A renewed token is refused for good if nothing has come with it since any connection first
    // used it, or if the login server issues it again.
    bool mayRenew() const {
        return m_refusedTokens.empty() ||
               (m_work.receivedCount() > m_receivedBefore &&
                std::find(m_refusedTokens.begin(), m_refusedTokens.end(),
                          m_connection.peer.secret) == m_refusedTokens.end());
    }
    void pause(std::chrono::milliseconds duration) const {
        const auto end = Clock::now() + duration;
        while (Clock::now() < end) {
            m_progress.check();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    const Server &m_server;
    RetrievalWork &m_work;
    const task::Progress &m_progress;
    std::atomic<int> &m_open; ///< connections, of all workers
    std::unique_ptr<network::Link> m_link;
    Objects m_objects;
    network::Connection m_connection;
    std::vector<std::string> m_refusedTokens; ///< the last one at the end
    std::size_t m_receivedBefore = 0;         ///< before the token was used
    std::string m_destinationAe;
    bool m_isAutomatic; ///< C-MOVE where there is no C-GET
    std::optional<Error> m_failure;
};

// Runs workers until no batch is left. *Throws* what stops them all, or the failure of all of them
// if nothing has come.
void runWorkers(const Server &server, Purpose purpose, const std::vector<std::string> &classes,
                const std::vector<std::string> &syntaxes, const std::string &destinationAe,
                Existing existing, EarlyLinks *early, RetrievalWork &work,
                const task::Progress &progress) {
    // A connection costs round trips, which a few objects do not repay.
    const std::size_t useful =
        std::max((work.missing() + firstBatchSize - 1) / firstBatchSize, work.wholeBatches());
    const std::size_t count = std::min(useful, std::size_t(grants().of(server)));
    std::atomic<int> open = 0;
    std::vector<std::unique_ptr<Worker>> workers;
    for (std::size_t n = 0; n < count; ++n)
        workers.push_back(std::make_unique<Worker>(
            server, purpose, classes, syntaxes, destinationAe,
            early != nullptr ? early->take() : nullptr, existing, open, work, progress));
    {
        std::vector<std::jthread> threads;
        for (std::size_t n = 1; n < workers.size(); ++n)
            threads.emplace_back([n, worker = workers[n].get()] { worker->run(n); });
        if (!workers.empty())
            workers.front()->run(0);
    }
    const bool hasGivenUp = std::any_of(workers.begin(), workers.end(), [](const auto &worker) {
        return worker->failure().has_value();
    });
    // One that gave way to another may have left its batch when that one had ended.
    if (!hasGivenUp && work.hasBatches())
        workers.front()->run(0);
    work.rethrow();
    if (work.receivedCount() == 0 && work.missing() > 0)
        for (const auto &worker : workers)
            if (worker->failure())
                throw *worker->failure();
}

// Senders that were refused because the server is not known to have their address.
class Strangers {
public:
    ListenerObserver observer() {
        return {[this](const ConnectionEnd &end) {
            if (!end.reason || !end.reason->is(because::senderIsUnknown))
                return;
            const std::lock_guard lock(m_mutex);
            if (m_first.empty())
                m_first = end.address;
        }};
    }
    std::string first() {
        const std::lock_guard lock(m_mutex);
        return m_first;
    }

private:
    std::mutex m_mutex;
    std::string m_first; ///< address
};

// Says in the folder of a study what is missing from it, also while it is retrieved, and if the
// retrieval ends early or the program is killed.
class MissingNote {
public:
    /// *Throws* Error{output}.
    MissingNote(std::filesystem::path folder, const std::vector<std::string> &seriesUids,
                const RetrievalWork &work)
        : m_folder(std::move(folder)), m_seriesUids(seriesUids), m_work(work) {
        files::createPrivateFolders(m_folder);
        set(work.missing());
    }
    ~MissingNote() {
        try {
            if (!m_isFinal)
                set(m_work.missing());
        } catch (const Error &) { // the disk is full: the first note stays
        }
        // A study of which nothing has come has no folder.
        std::error_code ignored;
        if (std::distance(std::filesystem::directory_iterator(m_folder, ignored),
                          std::filesystem::directory_iterator()) <= 1) {
            std::filesystem::remove(m_folder / dicom::missingObjectsName, ignored);
            std::filesystem::remove(m_folder, ignored);
        }
    }
    MissingNote(const MissingNote &) = delete;
    MissingNote &operator=(const MissingNote &) = delete;

    void set(std::size_t missing) { dicom::noteMissingObjects(m_folder, m_seriesUids, missing); }
    void setFinal(std::size_t missing) {
        m_isFinal = true;
        set(missing);
    }

private:
    std::filesystem::path m_folder;
    const std::vector<std::string> &m_seriesUids;
    const RetrievalWork &m_work;
    bool m_isFinal = false;
};

// For what a server sends because it is asked to.
ListenerOptions listenerFor(const Server &server, const std::string &ae, int port) {
    ListenerOptions options;
    options.port = port;
    options.ae = ae;
    // A request over TLS accepts its objects over TLS only.
    options.usesTls = server.peer.usesTls;
    if (options.usesTls && (server.peer.certificate.empty() || server.peer.authorities.empty()))
        throw Error(ErrorCode::unusable, because::receivingNeedsACertificate);
    options.certificate = server.peer.certificate;
    options.key = server.peer.key;
    options.keyPassword = server.peer.keyPassword;
    options.authorities = server.peer.authorities;
    for (const std::string &host : hostsOf(server))
        options.senders.push_back({"", host});
    options.silenceSeconds = server.peer.silenceSeconds;
    return options;
}

} // namespace

RetrievalReport retrieve(const Server &server, const Wanted &wanted, const ObjectFolder &folder,
                         const RetrievalObserver &observer, const task::Progress &progress,
                         const MoveDestination &destination) {
    const auto begin = Clock::now();
    std::optional<EarlyLinks> early(std::in_place, server, progress);
    const Listing listing = [&] {
        try {
            return listInstances(server, wanted, progress);
        } catch (const Error &error) {
            if (!isFull(error))
                throw;
        }
        early.reset(); // they may have taken all that the server grants
        return listInstances(server, wanted, progress);
    }();
    const std::vector<Instance> &instances = listing.instances;
    if (observer.listed)
        observer.listed(listing);
    folder.create();
    RetrievalWork work(listing, folder, observer, std::min(int(firstSlices), server.connections),
                       wanted.existing);
    MissingNote note(folder.folder() / wanted.studyUid, wanted.seriesUids, work);
    // Every connection proposes the missing kinds; a server that does not list them gets the
    // common ones.
    std::set<std::string> classes = work.classes();
    if (classes.contains(""))
        classes.clear();
    if (!areCommon(classes))
        early.reset(); // servers count connections
    if (server.retrieve != RetrieveMethod::move)
        runWorkers(server, Purpose::get, {classes.begin(), classes.end()}, {}, {}, wanted.existing,
                   early ? &*early : nullptr, work, progress);
    early.reset();
    const std::string destinationAe =
        destination.ae.empty() ? server.peer.callingAe : destination.ae;
    Strangers strangers;
    std::optional<Listener> listener;
    const auto moveAll = [&] {
        if (destination.isTakenByOtherTls)
            throw Error(ErrorCode::unusable, because::receiverDiffersInTls(destination.port));
        work.useMove();
        if (!destination.hasListener && !listener)
            listener.emplace(
                listenerFor(server, destinationAe, destination.port),
                [&] { return std::make_unique<Objects>(work, wanted.existing); },
                strangers.observer());
        runWorkers(server, Purpose::move, {}, {}, destinationAe, wanted.existing, nullptr, work,
                   progress);
        // Others may try to send, too.
        if (const std::string address = strangers.first();
            !address.empty() && work.receivedCount() == 0)
            work.refuseMissing(because::sentFromElsewhere(address));
    };
    bool hasMoved = server.retrieve == RetrieveMethod::move || work.needsMove();
    if (hasMoved)
        moveAll();
    // Some servers take the first presentation context of a kind, whatever they have stored, and
    // then cannot send it: one encoding at a time, until all is here.
    if (server.retrieve != RetrieveMethod::move && !hasMoved &&
        server.peer.protocol == network::Protocol::dicom)
        for (const std::string &syntax : network::transferSyntaxes())
            if (work.fillQueueAgain(instances))
                runWorkers(server, Purpose::get, {classes.begin(), classes.end()}, {syntax}, {},
                           wanted.existing, nullptr, work, progress);
    // Some servers list objects but cannot send them on the same association, or do not tell their
    // kinds, which it would have to propose.
    if (const std::size_t before = work.receivedCount();
        !hasMoved && server.retrieve == RetrieveMethod::automatic && work.missing() > 0 &&
        server.peer.protocol == network::Protocol::dicom && work.fillQueueAgain(instances)) {
        hasMoved = true;
        const std::map<std::string, task::Reason> reasons = work.reasons();
        try {
            moveAll();
        } catch (const Error &error) {
            if (error.code() == ErrorCode::output)
                throw;
        }
        if (work.receivedCount() == before) // the first reasons are the true ones
            work.restoreReasons(reasons);
    }
    // Objects that the server did not list are retrieved with their whole series.
    const bool isShort = work.fillQueueWithShortSeries();
    if (isShort && hasMoved) {
        moveAll();
    } else if (isShort) {
        std::set<std::string> all = classes;
        all.insert(network::commonClasses().begin(), network::commonClasses().end());
        runWorkers(server, Purpose::get, {all.begin(), all.end()}, {}, {}, wanted.existing, nullptr,
                   work, progress);
        if (work.needsMove())
            moveAll();
    }
    listener.reset();
    RetrievalReport report = work.report();
    note.setFinal(report.missing.size());
    if (report.state.received > 0)
        files::flush(folder.folder());
    // Neither a list nor an object.
    if (instances.empty() && report.state.received + report.state.present == 0)
        throw Error(ErrorCode::unusable, report.missing.empty()
                                             ? task::Reason(because::serverHasNoSuchStudy)
                                             : report.missing.front().reason);
    report.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return report;
}

} // namespace pellucid::archive
