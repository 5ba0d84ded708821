// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/listener.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <exception>
#include <list>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>

#include "core/files/descriptor.h"
#include "core/system/log.h"
#include "core/task/error.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using files::Descriptor;
using task::Error;
using task::ErrorCode;

constexpr int pollMs = 100; // the longest wait before the listener stops
constexpr std::size_t maxAtOnce = 16;

std::string textOf(const in_addr &address) {
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &address, text.data(), text.size());
    return text.data();
}

// Counts what a receiver keeps.
class Counting : public exchange::Receiver {
public:
    Counting(exchange::Receiver &receiver, std::size_t &kept)
        : m_receiver(receiver), m_kept(kept) {}

    std::variant<int, std::uint16_t> open(const exchange::Arrival &arrival) override {
        return m_receiver.open(arrival);
    }
    std::uint16_t keep(const exchange::Arrival &arrival, std::uint64_t bytes) override {
        const std::uint16_t status = m_receiver.keep(arrival, bytes);
        m_kept += status == exchange::status::success ? 1 : 0;
        return status;
    }
    void receive(std::uint64_t bytes) override { m_receiver.receive(bytes); }

private:
    exchange::Receiver &m_receiver;
    std::size_t &m_kept;
};

Descriptor openPort(int port, int &boundPort) {
    Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const int on = 1;
    ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(std::uint16_t(port));
    at.sin_addr.s_addr = htonl(INADDR_ANY);
    if (!socket || ::bind(socket.get(), reinterpret_cast<const sockaddr *>(&at), sizeof at) != 0 ||
        ::listen(socket.get(), int(maxAtOnce)) != 0) {
        const int failure = errno;
        if (failure == EADDRINUSE)
            throw Error(ErrorCode::unreachable, because::portIsInUse(port));
        throw Error(ErrorCode::usage, because::portCannotBeUsed(port, task::systemReason(failure)));
    }
    socklen_t size = sizeof at;
    ::getsockname(socket.get(), reinterpret_cast<sockaddr *>(&at), &size);
    boundPort = ntohs(at.sin_port);
    return socket;
}

} // namespace

class Listener::Threads {
public:
    Threads(ListenerOptions options, Receivers receivers, ListenerObserver observer)
        : m_options(std::move(options)), m_receivers(std::move(receivers)),
          m_observer(std::move(observer)), m_socket(openPort(m_options.port, m_port)),
          m_acceptor([this](const std::stop_token &stop) { acceptAll(stop); }) {}
    ~Threads() {
        m_acceptor.request_stop();
        m_acceptor.join();
        for (Connection &connection : m_connections)
            connection.thread.request_stop();
    }

    int port() const { return m_port; }

private:
    struct Connection {
        std::atomic<bool> hasEnded = false;
        std::jthread thread; // last: joins first
    };

    void acceptAll(const std::stop_token &stop) {
        while (!stop.stop_requested()) {
            m_connections.remove_if([](const Connection &one) { return one.hasEnded.load(); });
            pollfd waiting{m_socket.get(), POLLIN, 0};
            if (m_connections.size() >= maxAtOnce) {
                std::this_thread::sleep_for(std::chrono::milliseconds(pollMs));
                continue;
            }
            if (::poll(&waiting, 1, pollMs) <= 0)
                continue;
            sockaddr_in from{};
            socklen_t size = sizeof from;
            Descriptor client(::accept4(m_socket.get(), reinterpret_cast<sockaddr *>(&from), &size,
                                        SOCK_CLOEXEC));
            if (!client) { // perhaps the program has too many files open
                std::this_thread::sleep_for(std::chrono::milliseconds(pollMs));
                continue;
            }
            Connection &connection = m_connections.emplace_back();
            connection.thread =
                std::jthread([this, &connection, address = textOf(from.sin_addr),
                              socket = std::move(client)](const std::stop_token &stopping) mutable {
                    serve(std::move(socket), address, stopping);
                    connection.hasEnded = true;
                });
        }
    }

    // The senders at an address; nothing if none is known there.
    std::vector<std::string> titlesAt(const std::string &address) const {
        std::vector<std::string> titles;
        for (const Sender &sender : m_options.senders)
            if (const auto known = exchange::addressesOf(sender.host);
                std::find(known.begin(), known.end(), address) != known.end())
                titles.push_back(sender.ae);
        return titles;
    }

    void serve(Descriptor socket, const std::string &address, const std::stop_token &stop) {
        ConnectionEnd end{address, address};
        try {
            exchange::Acceptance acceptance{m_options.ae,          {},
                                            m_options.usesTls,     m_options.authorities,
                                            m_options.certificate, m_options.key,
                                            m_options.keyPassword, m_options.silenceSeconds};
            if (!m_options.acceptsAnyone) {
                acceptance.callingAes = titlesAt(address);
                // Not a byte of an unknown sender is read.
                if (acceptance.callingAes.empty())
                    throw Error(ErrorCode::unusable, because::senderIsUnknown(address));
                if (std::find(acceptance.callingAes.begin(), acceptance.callingAes.end(), "") !=
                    acceptance.callingAes.end())
                    acceptance.callingAes.clear();
            }
            const auto receiver = m_receivers();
            Counting counting(*receiver, end.stored);
            exchange::serveClient(std::move(socket), acceptance, counting, task::Progress(stop),
                                  [&](exchange::Step step, const std::string &found) {
                                      if (step == exchange::Step::association)
                                          end.sender = found;
                                  });
        } catch (const Error &error) {
            end.reason = error.reason();
        } catch (const task::Cancelled &) {
            end.reason = because::wasCancelled;
        } catch (const std::exception &error) {
            system::log(std::string("a connection ended: ") + error.what());
            end.reason = because::faultOfTheProgram;
        }
        const std::lock_guard lock(m_mutex);
        if (m_observer.ended)
            m_observer.ended(end);
    }

    ListenerOptions m_options;
    Receivers m_receivers;
    ListenerObserver m_observer;
    std::mutex m_mutex;
    int m_port = 0;
    Descriptor m_socket;
    std::list<Connection> m_connections;
    std::jthread m_acceptor;
};

Listener::Listener(ListenerOptions options, Receivers receivers, ListenerObserver observer)
    : m_threads(std::make_unique<Threads>(std::move(options), std::move(receivers),
                                          std::move(observer))) {}

Listener::~Listener() = default;

int Listener::port() const {
    return m_threads->port();
}

} // namespace pellucid::archive
