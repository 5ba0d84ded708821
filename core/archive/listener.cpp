// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/listener.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>

#include "core/archive/reasons.h"
#include "core/network/client/reasons.h"
#include "core/platform/socket.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using platform::Handle;
using task::Error;
using task::ErrorCode;

using Clock = std::chrono::steady_clock;

constexpr int pollMs = 100; // the longest wait before the listener stops
// As many as this program asks a server for at once: it sends the answer to each C-MOVE on a
// connection of its own.
constexpr std::size_t maxPerAddress = std::size_t(maxConnections);
constexpr std::size_t maxAtOnce = 4 * maxPerAddress;
constexpr std::size_t maxWaiting = maxPerAddress; // of an address, for one of its connections
// A negotiation takes a fraction of this, also with TLS and far away.
constexpr std::chrono::seconds negotiationGrace(2);
constexpr double slackSeconds = 2.0; // the helper itself ends a connection that is silent
// A long object may take longer than the limit of silence if its bytes keep coming. Lines are
// faster; a trickle that keeps a connection for ever is not.
constexpr double minBytesPerSecond = 1000.0;

Clock::duration seconds(double count) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(count));
}

// A client that has connected. Protected by the mutex of the listener, except its thread's own.
struct Connection {
    enum class State {
        waiting, ///< for other connections to end
        negotiating,
        associated,
        ending, ///< the listener has ended it
    };
    State state = State::waiting;
    std::string address;
    Clock::time_point begun; ///< its negotiation
    Clock::time_point deadline;
    std::optional<task::Reason> refusal; ///< why the listener has ended it
    std::atomic<bool> hasEnded = false;
    std::jthread thread; // last: joins first

    bool isServed() const { return state == State::negotiating || state == State::associated; }
    void end(const task::Reason &why) {
        state = State::ending;
        refusal = why;
        thread.request_stop();
    }
};

// Counts the objects that a receiver keeps, and extends the connection's deadline as bytes arrive.
class Watched : public network::Receiver {
public:
    using Extend = std::function<void(Clock::duration)>;
    Watched(network::Receiver &receiver, std::size_t &kept, Extend extend, double silenceSeconds)
        : m_receiver(receiver), m_kept(kept), m_extend(std::move(extend)),
          m_silenceSeconds(silenceSeconds) {}

    std::variant<platform::HandleView, std::uint16_t>
    open(const network::Arrival &arrival) override {
        auto opened = m_receiver.open(arrival);
        m_begun = Clock::now();
        m_extend(seconds(m_silenceSeconds));
        return opened;
    }
    std::uint16_t keep(const network::Arrival &arrival, std::uint64_t bytes) override {
        const std::uint16_t status = m_receiver.keep(arrival, bytes);
        m_kept += status == network::status::success ? 1 : 0;
        m_extend(seconds(m_silenceSeconds));
        return status;
    }
    void receive(std::uint64_t bytes) override {
        m_receiver.receive(bytes);
        m_extend(m_begun - Clock::now() +
                 seconds(m_silenceSeconds + double(bytes) / minBytesPerSecond));
    }

private:
    network::Receiver &m_receiver;
    std::size_t &m_kept;
    Extend m_extend;
    double m_silenceSeconds;
    Clock::time_point m_begun; // of the current object
};

platform::ListeningSocket openPort(const std::string &address, int port) {
    try {
        return platform::listenOn(address, port, int(maxAtOnce));
    } catch (const std::system_error &error) {
        if (error.code() == std::errc::address_in_use)
            throw Error(ErrorCode::unreachable, because::portIsInUse(port));
        if (error.code() == std::errc::address_not_available ||
            error.code() == std::errc::invalid_argument)
            throw Error(ErrorCode::usage, because::isNoListeningAddress(address));
        throw Error(ErrorCode::usage,
                    because::portCannotBeUsed(port, task::systemReason(error.code())));
    }
}

} // namespace

void requireValid(const ListenerOptions &options) {
    requireAeTitle(options.ae);
    if (!options.usesTls)
        return;
    if (options.certificate.empty() || options.key.empty())
        throw Error(ErrorCode::usage, because::certificateNeedsItsKey);
    // Not those of the system: anybody gets a certificate there.
    if (options.authorities.empty())
        throw Error(ErrorCode::usage, because::receiverNeedsAuthorities);
}

class Listener::Threads {
public:
    Threads(ListenerOptions options, Receivers receivers, ListenerObserver observer)
        : m_options(std::move(options)), m_receivers(std::move(receivers)),
          m_observer(std::move(observer)), m_listening(openPort(m_options.address, m_options.port)),
          m_acceptor([this](const std::stop_token &stop) { acceptAll(stop); }) {}
    ~Threads() {
        m_acceptor.request_stop();
        m_acceptor.join();
        for (Connection &connection : m_connections)
            connection.thread.request_stop();
        for (Connection &connection : m_connections) // before any is destroyed: they look around
            connection.thread.join();
    }

    int port() const { return m_listening.port; }

private:
    void acceptAll(const std::stop_token &stop) {
        while (!stop.stop_requested()) {
            const bool isFull = tidy() >= 2 * maxAtOnce;
            if (isFull) {
                std::this_thread::sleep_for(std::chrono::milliseconds(pollMs));
                continue;
            }
            if (!platform::awaitInput(m_listening.socket, pollMs))
                continue;
            auto client = platform::acceptFrom(m_listening.socket);
            if (!client) { // perhaps the program has too many files open
                std::this_thread::sleep_for(std::chrono::milliseconds(pollMs));
                continue;
            }
            begin(std::move(client->socket), client->address);
        }
    }

    // Ends what takes too long. *Returns* the number of connections that are left.
    std::size_t tidy() {
        const std::lock_guard lock(m_connectionsMutex);
        m_connections.remove_if([](const Connection &one) { return one.hasEnded.load(); });
        const auto now = Clock::now();
        for (Connection &one : m_connections)
            if (one.state != Connection::State::ending && now > one.deadline)
                one.end(reasonToEnd(one.state));
        return m_connections.size();
    }

    task::Reason reasonToEnd(Connection::State state) const {
        switch (state) {
        case Connection::State::waiting:
            return because::senderHasTooManyConnections;
        case Connection::State::negotiating:
            return because::senderMakesNoAssociation(std::lround(m_options.negotiationSeconds));
        default:
            return because::senderMakesNoProgress(std::lround(m_options.silenceSeconds));
        }
    }

    void begin(Handle client, const std::string &address) {
        const std::lock_guard lock(m_connectionsMutex);
        const auto waits = [&](const Connection &one) {
            return one.state == Connection::State::waiting && one.address == address;
        };
        if (std::count_if(m_connections.begin(), m_connections.end(), waits) >=
            std::ptrdiff_t(maxWaiting))
            std::find_if(m_connections.begin(), m_connections.end(), waits)
                ->end(because::senderHasTooManyConnections);
        Connection &connection = m_connections.emplace_back();
        connection.address = address;
        connection.deadline = Clock::now() + seconds(m_options.negotiationSeconds);
        connection.thread = std::jthread([this, &connection, socket = std::move(client)](
                                             const std::stop_token &stopping) mutable {
            serve(std::move(socket), connection, stopping);
            connection.hasEnded = true;
        });
    }

    // Waits until the connection may be served. *Throws* Cancelled.
    void awaitTurn(Connection &connection, const task::Progress &progress) {
        while (!takesTurn(connection)) {
            progress.check();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }
    bool takesTurn(Connection &connection) {
        const std::lock_guard lock(m_connectionsMutex);
        if (connection.state == Connection::State::ending)
            return false;
        const auto now = Clock::now();
        std::size_t all = 0, alike = 0;
        for (const Connection &one : m_connections) {
            all += one.isServed() ? 1 : 0;
            alike += one.isServed() && one.address == connection.address ? 1 : 0;
        }
        if (all >= maxAtOnce || alike >= maxPerAddress) {
            // The oldest that has not negotiated gives way.
            const auto idle =
                std::find_if(m_connections.begin(), m_connections.end(), [&](Connection &one) {
                    return one.state == Connection::State::negotiating &&
                           now - one.begun > negotiationGrace &&
                           (alike < maxPerAddress || one.address == connection.address);
                });
            if (idle == m_connections.end())
                return false;
            idle->end(because::senderHasTooManyConnections);
        }
        connection.state = Connection::State::negotiating;
        connection.begun = now;
        connection.deadline = now + seconds(m_options.negotiationSeconds);
        return true;
    }

    // Those at an address.
    std::vector<Sender> sendersAt(const std::string &address) const {
        std::vector<Sender> senders;
        for (const Sender &sender : m_options.senders)
            if (const auto known = platform::addressesOf(sender.host);
                std::find(known.begin(), known.end(), address) != known.end())
                senders.push_back(sender);
        return senders;
    }

    network::Acceptance acceptanceFor(const std::string &address) const {
        network::Acceptance acceptance{m_options.ae,
                                       {},
                                       {},
                                       m_options.usesTls,
                                       m_options.authorities,
                                       m_options.certificate,
                                       m_options.key,
                                       m_options.keyPassword,
                                       m_options.silenceSeconds};
        if (m_options.acceptsAnyone)
            return acceptance;
        const std::vector<Sender> senders = sendersAt(address);
        // Not a byte of an unknown sender is read.
        if (senders.empty())
            throw Error(ErrorCode::unusable, because::senderIsUnknown(address));
        acceptance.clientHosts.push_back(address);
        for (const Sender &sender : senders) {
            acceptance.clientHosts.push_back(sender.host);
            acceptance.callingAes.push_back(sender.ae);
        }
        if (std::find(acceptance.callingAes.begin(), acceptance.callingAes.end(), "") !=
            acceptance.callingAes.end())
            acceptance.callingAes.clear();
        return acceptance;
    }

    void serve(Handle socket, Connection &connection, const std::stop_token &stop) {
        const std::string address = connection.address;
        ConnectionEnd end{address, address};
        const auto extend = [&](Clock::duration duration) {
            const std::lock_guard lock(m_connectionsMutex);
            connection.deadline = Clock::now() + duration + seconds(slackSeconds);
        };
        try {
            const network::Acceptance acceptance = acceptanceFor(address);
            const task::Progress progress(stop);
            awaitTurn(connection, progress);
            const auto receiver = m_receivers();
            Watched watched(*receiver, end.stored, extend, m_options.silenceSeconds);
            network::serveClient(std::move(socket), acceptance, watched, progress,
                                 [&](network::Step step, const std::string &found) {
                                     if (step == network::Step::refused)
                                         end.refused = because::kindsAreRefused(found);
                                     if (step == network::Step::association) {
                                         end.sender = found;
                                         const std::lock_guard lock(m_connectionsMutex);
                                         if (connection.state == Connection::State::negotiating)
                                             connection.state = Connection::State::associated;
                                     }
                                     if (step == network::Step::association ||
                                         step == network::Step::service)
                                         extend(seconds(m_options.silenceSeconds));
                                 });
        } catch (const Error &error) {
            end.reason = error.reason();
        } catch (const task::Cancelled &) {
            const std::lock_guard lock(m_connectionsMutex);
            end.reason = connection.refusal.value_or(because::wasCancelled);
        } catch (const std::exception &error) {
            system::log(std::string("a connection ended: ") + error.what());
            end.reason = because::faultOfTheProgram;
        }
        {
            const std::lock_guard lock(m_connectionsMutex);
            connection.state = Connection::State::ending;
        }
        const std::lock_guard lock(m_mutex);
        if (m_observer.ended)
            m_observer.ended(end);
    }

    ListenerOptions m_options;
    Receivers m_receivers;
    ListenerObserver m_observer;
    std::mutex m_mutex; // of the observer
    platform::ListeningSocket m_listening;
    std::mutex m_connectionsMutex;
    std::list<Connection> m_connections;
    std::jthread m_acceptor;
};

Listener::Listener(ListenerOptions options, Receivers receivers, ListenerObserver observer) {
    requireValid(options);
    m_threads =
        std::make_unique<Threads>(std::move(options), std::move(receivers), std::move(observer));
}

Listener::~Listener() = default;

int Listener::port() const {
    return m_threads->port();
}

} // namespace pellucid::archive
