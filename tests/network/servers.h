// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <random>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "tests/network/acceptor.h"
#include "tests/support/temporary_folder.h"

/// Real servers for tests, and what stands between them and the program.
namespace pellucid::test {

/// `from`: an address of this computer; null: any.
inline int connectTo(int port, const char *from = nullptr) {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    if (from != nullptr) {
        at.sin_addr.s_addr = ::inet_addr(from);
        ::bind(socket, reinterpret_cast<sockaddr *>(&at), sizeof at);
    }
    at.sin_port = htons(std::uint16_t(port));
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket, reinterpret_cast<sockaddr *>(&at), sizeof at) != 0) {
        ::close(socket);
        return -1;
    }
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return socket;
}

/// A port for a server that starts later. It lies below those that Linux gives to connections
/// (from 32768 on): one of a test beside this one could take it meanwhile.
inline int freePort() {
    std::random_device random;
    while (true) {
        int port = std::uniform_int_distribution(10000, 32000)(random);
        try {
            ::close(listenOn(port));
            return port;
        } catch (const std::exception &) { // it is in use
        }
    }
}

inline bool isInstalled(const std::string &program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A program that runs until the object is destroyed.
class Server {
public:
    Server(const std::vector<std::string> &command, int port) : m_port(port) {
        m_pid = ::fork();
        if (m_pid == 0) {
            (void)!::freopen("/dev/null", "w", stdout);
            (void)!::freopen("/dev/null", "w", stderr);
            std::vector<char *> arguments;
            for (const std::string &part : command)
                arguments.push_back(const_cast<char *>(part.c_str()));
            arguments.push_back(nullptr);
            ::execvp(arguments[0], arguments.data());
            ::_exit(127);
        }
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::chrono::steady_clock::now() < end) {
            if (const int socket = connectTo(port); socket >= 0) {
                ::close(socket);
                return;
            }
            ::usleep(20000);
        }
        throw std::runtime_error(command[0] + " does not start");
    }
    ~Server() {
        ::kill(m_pid, SIGKILL);
        ::waitpid(m_pid, nullptr, 0);
    }
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;
    int port() const { return m_port; }

private:
    pid_t m_pid = -1;
    int m_port;
};

/// DCMTK's image archive, with the AE title COMMON. It can send to PELLUCID at `destinationPort`.
class Dcmqrscp {
public:
    explicit Dcmqrscp(const std::vector<std::string> &options = {})
        : destinationPort(freePort()), m_port(freePort()) {
        std::filesystem::create_directories(m_folder / "COMMON");
        std::ofstream(m_folder / "qr.cfg")
            << "NetworkTCPPort = " << m_port << "\nMaxPDUSize = 131072\nMaxAssociations = 32\n"
            << "HostTable BEGIN\nus = (PELLUCID, 127.0.0.1, " << destinationPort
            << ")\nHostTable END\nVendorTable BEGIN\nVendorTable END\nAETable BEGIN\nCOMMON "
            << (m_folder / "COMMON").string() << " RW (10000, 1024mb) ANY\nAETable END\n";
        std::vector<std::string> command{"dcmqrscp", "-c", (m_folder / "qr.cfg").string()};
        command.insert(command.end(), options.begin(), options.end());
        m_server = std::make_unique<Server>(command, m_port);
    }
    int port() const { return m_port; }
    const int destinationPort;

private:
    TemporaryFolder m_folder;
    int m_port;
    std::unique_ptr<Server> m_server;
};

/// Orthanc, with the AE title ORTHANC.
class Orthanc {
public:
    explicit Orthanc(const std::string &more = {}) : m_port(freePort()), m_webPort(freePort()) {
        std::ofstream(m_folder / "orthanc.json")
            << R"({"Name": "test", "StorageDirectory": ")" << m_folder.path().string()
            << R"(", "IndexDirectory": ")" << m_folder.path().string() << R"(", "HttpPort": )"
            << m_webPort << R"(, "DicomPort": )" << m_port
            << R"(, "DicomAet": "ORTHANC", "RemoteAccessAllowed": false,
                "AuthenticationEnabled": false, "DicomAlwaysAllowGet": true,
                "DicomAlwaysAllowFind": true, "DicomAlwaysAllowStore": true,
                "DicomAlwaysAllowEcho": true, "TcpNoDelay": true)"
            << more << "}";
        m_server = std::make_unique<Server>(
            std::vector<std::string>{"Orthanc", (m_folder / "orthanc.json").string()}, m_port);
    }
    int port() const { return m_port; }
    int webPort() const { return m_webPort; }
    /// The configuration that adds the DICOMweb service /dicom-web.
    static std::string dicomWeb() {
        return ", \"Plugins\": [\"/usr/share/orthanc/plugins/libOrthancDicomWeb.so\"], "
               "\"DicomWeb\": {\"Enable\": true, \"Root\": \"/dicom-web/\"}";
    }

private:
    TemporaryFolder m_folder;
    int m_port, m_webPort;
    std::unique_ptr<Server> m_server;
};

/// PixelMed's server in Java, with the AE title PIXELMED. It can send to PELLUCID at
/// `destinationPort`, and takes no lists of objects.
class PixelMed {
public:
    PixelMed() : destinationPort(freePort()), m_port(freePort()) {
        std::filesystem::create_directories(m_folder / "images");
        std::ofstream(m_folder / "properties")
            << "Dicom.ListeningPort=" << m_port << "\nDicom.CalledAETitle=PIXELMED\n"
            << "Dicom.CallingAETitle=PIXELMED\nDicom.PrimaryDeviceType=ARCHIVE\n"
            << "Application.DatabaseFileName=" << (m_folder / "list").string() << "\n"
            << "Application.SavedImagesFolderName=" << (m_folder / "images").string() << "\n"
            << "Dicom.RemoteAEs=us\nDicom.RemoteAEs.us.CalledAETitle=PELLUCID\n"
            << "Dicom.RemoteAEs.us.HostNameOrIPAddress=127.0.0.1\n"
            << "Dicom.RemoteAEs.us.Port=" << destinationPort << "\n"
            << "WebServer.ListeningPort=" << freePort() << "\n"
            << "WebServer.RequestTypeFactory=com.pixelmed.web.AllRequestTypeFactory\n";
        std::string path;
        for (const char *const name : {"pixelmed", "hsqldb", "jaxb-api", "vecmath", "slf4j-api",
                                       "slf4j-nop", "commons-codec", "commons-net"})
            path += std::string(path.empty() ? "" : ":") + "/usr/share/java/" + name + ".jar";
        m_server = std::make_unique<Server>(
            std::vector<std::string>{"java", "-cp", path,
                                     "com.pixelmed.server.DicomAndWebStorageServer",
                                     (m_folder / "properties").string()},
            m_port);
    }
    static bool isInstalled() {
        return test::isInstalled("java") && std::filesystem::exists("/usr/share/java/pixelmed.jar");
    }
    int port() const { return m_port; }
    const int destinationPort;

private:
    TemporaryFolder m_folder;
    int m_port;
    std::unique_ptr<Server> m_server;
};

/// What a proxy does to a connection, counted in bytes from the server. Not set: nothing.
struct Mischief {
    long cutAfter = -1, stallAfter = -1, flipAt = -1;
    int delayMs = 0;             ///< of each direction
    double bytesPerSecond = 0.0; ///< from the server, of all connections together; 0: no limit
};

/// Stands between the program and a server. Thread-safe.
class Proxy {
public:
    explicit Proxy(int serverPort)
        : m_serverPort(serverPort), m_acceptor([this](int client) { serve(client); }) {}
    int port() const { return m_acceptor.port(); }
    /// For connections from now on.
    void set(const Mischief &mischief) {
        const std::lock_guard lock(m_mutex);
        m_mischief = mischief;
    }
    int connections() const { return m_connections; }
    /// The bytes that have come from the program, of all connections.
    std::string fromProgram() {
        const std::lock_guard lock(m_mutex);
        return m_fromProgram;
    }

private:
    void serve(int client) {
        const int server = connectTo(m_serverPort);
        if (server < 0)
            return;
        ++m_connections;
        Mischief mischief;
        {
            const std::lock_guard lock(m_mutex);
            mischief = m_mischief;
        }
        pass(client, server, mischief);
        ::close(server);
    }

    // Bytes on their way, with the moment of their arrival.
    struct Parcel {
        std::chrono::steady_clock::time_point due;
        std::vector<char> bytes;
    };

    // Returns when one side has closed the connection.
    void pass(int client, int server, const Mischief &mischief) {
        using Clock = std::chrono::steady_clock;
        std::array<std::vector<Parcel>, 2> queues; // to the server, to the client
        long fromServer = 0;
        // Connections that share a line take turns.
        std::vector<char> buffer(mischief.bytesPerSecond > 0.0 ? 1 << 13 : 1 << 16);
        bool isStalled = false;
        constexpr std::size_t mostWaiting = 4; // then the server has to wait
        for (;;) {
            for (int way = 0; way < 2; ++way)
                while (!queues[std::size_t(way)].empty() &&
                       queues[std::size_t(way)].front().due <= Clock::now()) {
                    const auto &bytes = queues[std::size_t(way)].front().bytes;
                    for (std::size_t sent = 0; sent < bytes.size();) {
                        const ssize_t now = ::send(way == 0 ? server : client, bytes.data() + sent,
                                                   bytes.size() - sent, MSG_NOSIGNAL);
                        if (now <= 0)
                            return;
                        sent += std::size_t(now);
                    }
                    queues[std::size_t(way)].erase(queues[std::size_t(way)].begin());
                }
            std::array<pollfd, 2> waiting{pollfd{client, POLLIN, 0}, pollfd{server, POLLIN, 0}};
            const bool isPending = !queues[0].empty() || !queues[1].empty();
            if (::poll(waiting.data(), 2, isPending ? 1 : 20) <= 0)
                continue;
            for (int from = 0; from < 2; ++from) {
                if (waiting[std::size_t(from)].revents == 0 || isStalled)
                    continue;
                if (mischief.bytesPerSecond > 0.0 && queues[1].size() >= mostWaiting && from == 1) {
                    ::usleep(500);
                    continue;
                }
                const ssize_t got =
                    ::recv(from == 0 ? client : server, buffer.data(), buffer.size(), 0);
                if (got <= 0)
                    return;
                if (from == 1) { // as the program does: servers with Nagle's algorithm wait for it
                    const int on = 1;
                    ::setsockopt(server, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
                }
                std::vector<char> bytes(buffer.begin(), buffer.begin() + got);
                if (from == 0) {
                    const std::lock_guard lock(m_mutex);
                    m_fromProgram.append(bytes.data(), bytes.size());
                }
                if (from == 1) {
                    if (mischief.flipAt >= fromServer && mischief.flipAt < fromServer + got)
                        bytes[std::size_t(mischief.flipAt - fromServer)] ^= 0x10;
                    fromServer += got;
                    if (mischief.cutAfter >= 0 && fromServer > mischief.cutAfter)
                        return;
                    isStalled = mischief.stallAfter >= 0 && fromServer > mischief.stallAfter;
                }
                auto due = Clock::now() + std::chrono::milliseconds(mischief.delayMs);
                if (from == 1 && mischief.bytesPerSecond > 0.0) {
                    const std::lock_guard lock(m_mutex);
                    m_lineIsFree =
                        std::max(m_lineIsFree, Clock::now()) +
                        std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(double(got) / mischief.bytesPerSecond));
                    due = std::max(due, m_lineIsFree);
                }
                queues[std::size_t(from)].push_back({due, std::move(bytes)});
            }
            if (isStalled) {
                if (std::array<char, 64> byte{};
                    ::recv(client, byte.data(), byte.size(), MSG_DONTWAIT) == 0)
                    return; // the program has given up
                ::usleep(20000);
            }
        }
    }

    int m_serverPort;
    std::mutex m_mutex;
    Mischief m_mischief;
    std::chrono::steady_clock::time_point m_lineIsFree; ///< for the next byte from the server
    std::string m_fromProgram;
    std::atomic<int> m_connections = 0;
    Acceptor m_acceptor; // last: its threads use the others
};

} // namespace pellucid::test
