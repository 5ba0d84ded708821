// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <arpa/inet.h>
#include <cstdint>
#include <functional>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdexcept>
#include <stop_token>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace pellucid::test {

/// A socket that listens on an address of this computer. `port`: 0: a free one, which is written
/// there. *Throws* if the port is in use.
inline int listenOn(int &port, const char *address = "127.0.0.1") {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int on = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(std::uint16_t(port));
    at.sin_addr.s_addr = ::inet_addr(address);
    if (::bind(socket, reinterpret_cast<sockaddr *>(&at), sizeof at) != 0 ||
        ::listen(socket, 64) != 0) {
        ::close(socket);
        throw std::runtime_error("no port");
    }
    socklen_t size = sizeof at;
    ::getsockname(socket, reinterpret_cast<sockaddr *>(&at), &size);
    port = ntohs(at.sin_port);
    return socket;
}

/// Listens on a free port, and serves each connection in a thread of its own. The end
/// shuts all connections down, and waits for the threads.
class Acceptor {
public:
    /// `serve`: gets the socket of a connection, which is shut down when it returns. It returns
    /// soon after the other side has closed the connection.
    explicit Acceptor(std::function<void(int client)> serve, const char *address = "127.0.0.1")
        : m_serve(std::move(serve)), m_socket(listenOn(m_port, address)),
          m_thread([this](const std::stop_token &stop) { acceptAll(stop); }) {}
    ~Acceptor() {
        m_thread.request_stop();
        m_thread.join();
        for (const int client : m_clients)
            ::shutdown(client, SHUT_RDWR);
        m_threads.clear();
        for (const int client : m_clients)
            ::close(client);
        ::close(m_socket);
    }
    Acceptor(const Acceptor &) = delete;
    Acceptor &operator=(const Acceptor &) = delete;
    int port() const { return m_port; }

private:
    void acceptAll(const std::stop_token &stop) {
        while (!stop.stop_requested()) {
            pollfd waiting{m_socket, POLLIN, 0};
            if (::poll(&waiting, 1, 20) <= 0)
                continue;
            const int client = ::accept4(m_socket, nullptr, nullptr, SOCK_CLOEXEC);
            if (client < 0) { // too many descriptors, perhaps
                ::usleep(20000);
                continue;
            }
            const int on = 1;
            ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            m_clients.push_back(client); // closed at the end, so that no number is used twice
            m_threads.emplace_back([this, client] {
                m_serve(client);
                ::shutdown(client, SHUT_RDWR);
            });
        }
    }

    std::function<void(int client)> m_serve;
    int m_port = 0, m_socket;
    std::vector<int> m_clients; // of the thread that accepts, until it has ended
    std::vector<std::jthread> m_threads;
    std::jthread m_thread;
};

} // namespace pellucid::test
