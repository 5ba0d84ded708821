// SPDX-License-Identifier: GPL-3.0-or-later
// The listener and those who connect to it: strangers, the slow, and too many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <optional>
#include <poll.h>
#include <string>
#include <sys/mount.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/archive/listener.h"
#include "core/archive/reasons.h"
#include "core/archive/receiving.h"
#include "core/archive/sending.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"
#include "tests/network/pacs.h"
#include "tests/network/processes.h"
#include "tests/network/scripted_server.h"
#include "tests/support/command.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/files.h"

namespace pellucid {

using namespace test;
namespace because = task::because;
using Clock = std::chrono::steady_clock;

namespace {

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// A connection to a port of this computer, from one of its addresses.
class Client {
public:
    explicit Client(int port, const std::string &from = "127.0.0.1",
                    const std::string &to = "127.0.0.1")
        : m_socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in at = placeOf(from, 0);
        ::bind(m_socket, reinterpret_cast<sockaddr *>(&at), sizeof at);
        at = placeOf(to, port);
        m_isConnected = ::connect(m_socket, reinterpret_cast<sockaddr *>(&at), sizeof at) == 0;
    }
    ~Client() { ::close(m_socket); }
    Client(const Client &) = delete;
    Client &operator=(const Client &) = delete;

    bool isConnected() const { return m_isConnected; }
    bool send(const std::string &bytes) const {
        return ::send(m_socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == ssize_t(bytes.size());
    }
    // Whether the other side has closed the connection, or does so within the time.
    bool isClosedWithin(double seconds) const {
        const auto begin = Clock::now();
        while (secondsSince(begin) < seconds) {
            pollfd waiting{m_socket, POLLIN, 0};
            std::array<char, 4096> bytes{};
            if (::poll(&waiting, 1, 20) > 0 &&
                ::recv(m_socket, bytes.data(), bytes.size(), MSG_DONTWAIT) <= 0)
                return true;
        }
        return false;
    }
    std::string receive() const {
        std::string bytes(4096, '\0');
        bytes.resize(std::size_t(std::max<ssize_t>(0, ::recv(m_socket, bytes.data(), 4096, 0))));
        return bytes;
    }
    int socket() const { return m_socket; }

private:
    static sockaddr_in placeOf(const std::string &address, int port) {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_port = htons(std::uint16_t(port));
        ::inet_pton(AF_INET, address.c_str(), &at.sin_addr);
        return at;
    }

    int m_socket;
    bool m_isConnected = false;
};

using Clients = std::vector<std::unique_ptr<Client>>;

// Connections that say nothing but their first byte, and have their share of the helpers.
void flood(Clients &clients, int count, int port, const std::string &from) {
    for (int n = 0; n < count; ++n) {
        clients.push_back(std::make_unique<Client>(port, from));
        clients.back()->send(std::string(1, '\1'));
    }
    const auto begin = Clock::now();
    while (ownHelpers().size() < std::size_t(archive::maxConnections) && secondsSince(begin) < 30.0)
        ::usleep(10000);
}

std::string associationRequest(const std::string &callingAe) {
    return ScriptedAssociation::associationRequest({"PELLUCID", callingAe, {uid::capture}});
}

// A folder on a file system of its own.
class SmallDisk {
public:
    SmallDisk(const fs::path &folder, const std::string &options) : m_folder(folder) {
        fs::create_directories(folder);
        m_isMounted = ::mount("pellucid-test", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
    }
    ~SmallDisk() {
        if (m_isMounted)
            ::umount2(m_folder.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk &) = delete;
    SmallDisk &operator=(const SmallDisk &) = delete;
    bool isMounted() const { return m_isMounted; }

private:
    fs::path m_folder;
    bool m_isMounted = false;
};

// A listener for two senders: KNOWN at 127.0.0.1, OTHER at 127.0.0.2.
class PacsListener : public PacsScripted {
protected:
    void SetUp() override {
        m_options.port = 0;
        m_options.senders = {{"KNOWN", "127.0.0.1"}, {"OTHER", "127.0.0.2"}};
        fs::create_directories(m_objects.folder());
    }
    void start() {
        m_listener.emplace(
            m_options, [this] { return m_receiving.receiver(); },
            archive::ListenerObserver{[this](const archive::ConnectionEnd &end) {
                const std::lock_guard lock(m_mutex);
                m_ends.push_back(end);
            }});
    }
    int port() const { return m_listener->port(); }
    /// Stops the listener. *Shape*: the reasons of all connections that have ended.
    std::vector<std::string> reasons() {
        m_listener.reset();
        std::vector<std::string> reasons;
        for (const archive::ConnectionEnd &end : m_ends)
            reasons.push_back(end.reason ? end.reason->english() : "");
        return reasons;
    }
    /// How long KNOWN waits for the answer to a C-ECHO; nothing if there is none.
    std::optional<double> echoSeconds(const std::string &to = "127.0.0.1") const {
        archive::Server us = serverAt(port(), "PELLUCID");
        us.peer.host = to;
        us.peer.callingAe = "KNOWN";
        us.peer.associationSeconds = 30.0;
        const auto begin = Clock::now();
        try {
            network::Link link(network::Connection{us.peer, network::Purpose::echo});
            link.echo();
        } catch (const task::Error &) {
            return std::nullopt;
        }
        return secondsSince(begin);
    }
    /// The same while half-open connections flood the listener; infinite if there is no answer.
    double echoSecondsInFlood(int count, const std::string &from) {
        m_options.negotiationSeconds = 60.0;
        start();
        Clients clients;
        flood(clients, count, port(), from);
        const double answered = echoSeconds().value_or(std::numeric_limits<double>::infinity());
        std::cout << "answered after " << answered << " s\n";
        return answered;
    }

    archive::ListenerOptions m_options;
    archive::ObjectFolder m_objects{m_folder / "in", archive::ObjectFolder::Durability::synced};
    std::vector<archive::RefusedObject> m_refused;
    archive::Receiving m_receiving{
        m_objects, nullptr, {{}, [this](const archive::RefusedObject &object) {
                                 m_refused.push_back(object);
                             }}};
    std::mutex m_mutex;
    std::vector<archive::ConnectionEnd> m_ends;
    std::optional<archive::Listener> m_listener; // last: its threads use the others
};

} // namespace

// It takes its share of the connections, and no more.
TEST_F(PacsListener, AFloodFromOneAddressDoesNotCloseItForOthers) {
    EXPECT_LT(echoSecondsInFlood(100, "127.0.0.2"), 2.0);
}

// Half-open connections give way after two seconds, the oldest first.
TEST_F(PacsListener, AFloodFromAnAddressDoesNotCloseItForTheSameAddress) {
    EXPECT_LT(echoSecondsInFlood(33, "127.0.0.1"), 10.0);
    EXPECT_THAT(reasons(),
                testing::Contains(task::Reason(because::senderHasTooManyConnections).english()));
}

// Bytes that keep coming do not extend the time to negotiate.
TEST_F(PacsListener, ASlowNegotiationIsEnded) {
    m_options.negotiationSeconds = 1.0;
    start();
    const Client client(port());
    const std::string request = associationRequest("KNOWN");
    const auto begin = Clock::now();
    for (std::size_t n = 0; n < request.size() && !client.isClosedWithin(0.05); ++n)
        client.send(request.substr(n, 1)); // 200 bytes: ten seconds
    EXPECT_LT(secondsSince(begin), 5.0);
    EXPECT_THAT(reasons(),
                testing::ElementsAre(task::Reason(because::senderMakesNoAssociation(1)).english()));
}

// Nor does a trickle keep an association for ever.
TEST_F(PacsListener, AnAssociationWithoutProgressIsEnded) {
    m_options.silenceSeconds = 1.0;
    start();
    const Client client(port());
    client.send(associationRequest("KNOWN"));
    ASSERT_EQ(client.receive().substr(0, 1), "\2"); // accepted
    client.send(ScriptedAssociation::pdu(4, "").substr(0, 2) +
                ScriptedAssociation::big(16000, 4)); // of a message that comes byte by byte
    const auto begin = Clock::now();
    while (secondsSince(begin) < 20.0 && !client.isClosedWithin(0.2))
        client.send(std::string(1, '\0'));
    EXPECT_LT(secondsSince(begin), 10.0);
    EXPECT_THAT(reasons(),
                testing::ElementsAre(task::Reason(because::senderMakesNoProgress(1)).english()));
}

// An object that takes longer than the limit of silence is progress.
TEST_F(PacsListener, ALongObjectOnASlowLineIsKept) {
    if (!isInstalled("storescu"))
        GTEST_SKIP() << "storescu is not installed";
    const fs::path sent = series("L", 1, 512); // 0.5 MB
    m_options.silenceSeconds = 1.0;
    start();
    const Acceptor slow([this](int client) {
        const int server = connectTo(port());
        std::array<char, 4096> bytes{};
        const auto pass = [&](int from, int to) {
            const ssize_t got = ::recv(from, bytes.data(), bytes.size(), 0);
            return got > 0 && ::send(to, bytes.data(), std::size_t(got), MSG_NOSIGNAL) == got;
        };
        for (bool isOpen = true; isOpen;) {
            std::array<pollfd, 2> waiting{pollfd{client, POLLIN, 0}, pollfd{server, POLLIN, 0}};
            ::poll(waiting.data(), 2, 100);
            if (waiting[0].revents != 0) {
                isOpen = pass(client, server);
                ::usleep(50000); // 80 kB/s
            }
            if (isOpen && waiting[1].revents != 0)
                isOpen = pass(server, client);
        }
        ::close(server);
    });
    const auto begin = Clock::now();
    const auto result = run("storescu -R -aet KNOWN -aec PELLUCID +sd 127.0.0.1 " +
                            std::to_string(slow.port()) + " '" + sent.string() + "'");
    EXPECT_GT(secondsSince(begin), 4.0) << "too fast to show anything";
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_EQ(dataSetsIn(m_objects.folder()), dataSetsIn(sent));
}

TEST_F(PacsListener, ItListensOnOneAddressOnly) {
    m_options.address = "127.0.0.3";
    start();
    EXPECT_TRUE(Client(port(), "127.0.0.1", "127.0.0.3").isConnected());
    EXPECT_FALSE(Client(port(), "127.0.0.1", "127.0.0.1").isConnected());
    EXPECT_TRUE(echoSeconds("127.0.0.3").has_value());
    for (const char *const none : {"192.0.2.1", "nowhere", "127.0.0.256", "255.255.255.255"}) {
        m_options.address = none;
        try {
            start();
            ADD_FAILURE() << none;
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::usage);
            EXPECT_TRUE(error.reason().is(because::isNoListeningAddress));
        }
    }
}

TEST_F(PacsListener, ItListensOnIpv6) {
    m_options.senders = {{"KNOWN", "::1"}};
    start();
    archive::Server us = serverAt(port(), "PELLUCID");
    us.peer = archive::dicomPeer("PELLUCID@[::1]:" + std::to_string(port()));
    us.peer.callingAe = "KNOWN";
    const fs::path sent = series("six", 3);
    const auto report = archive::send(us, {sent});
    EXPECT_EQ(report.state.sent, 3U)
        << (report.notSent.empty() ? "" : report.notSent[0].reason.english());
    EXPECT_EQ(dataSetsIn(m_objects.folder()), dataSetsIn(sent));
    // A sender of IPv4 is another one.
    EXPECT_FALSE(echoSeconds().has_value());
}

// Kinds of objects that a maker defines, or that are newer than this program;
// and each data set byte for byte, with what a library would tidy up.
TEST_F(PacsListener, EveryObjectIsSentAndStoredAsItIs) {
    m_options.senders = {{"KNOWN", "127.0.0.1"}};
    start();
    archive::Server us = serverAt(port(), "PELLUCID");
    us.peer.callingAe = "KNOWN";
    fs::create_directories(m_folder / "odd");
    int number = 0;
    for (const auto &[sopClass, syntax] :
         {std::pair("1.2.3.4.5.6", "1.2.840.10008.1.2.1"),
          std::pair("1.2.840.10008.5.1.4.1.1.999.1", "1.2.840.10008.1.2"),
          std::pair("1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.1.2.4.201"),
          std::pair("1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.1.2.4.203")}) {
        DicomWriter w = sliceOf({}, number);
        w.put({0x0008, 0x0000}, "UL", DicomWriter::number(std::uint32_t(12345))); // a group length
        w.put({0x0008, 0x0016}, "UI", sopClass);
        w.put({0x0010, 0x1010}, "UN", "042Y"); // Patient's Age
        w.put({0x0010, 0x4000}, "LT", "blanks at its end      ");
        DicomWriter::Form form;
        form.syntax = syntax;
        form.isImplicit = form.syntax == "1.2.840.10008.1.2";
        if (form.syntax.find(".4.20") != std::string::npos)
            w.putFragments({std::string("\xff\x4f\xff\x51", 4) + std::string(60, 'x')});
        writeText(m_folder / "odd" / (std::to_string(number++) + ".dcm"), w.file(form));
    }
    const auto report = archive::send(us, {m_folder / "odd"});
    // High-Throughput JPEG 2000 costs itself only, and the reason names a way.
    EXPECT_EQ(report.state.sent, 2U);
    ASSERT_EQ(report.notSent.size(), 2U);
    for (const dicom::Skipped &file : report.notSent) {
        EXPECT_TRUE(file.reason.is(because::mayBeUncompressed)) << file.reason.english();
        fs::remove(file.path);
    }
    EXPECT_EQ(dataSetsIn(m_objects.folder()), dataSetsIn(m_folder / "odd"));
}

// Whoever proposes what is no object learns it, and the user learns what was refused.
TEST_F(PacsListener, RefusedKindsAreNamed) {
    m_options.senders = {{"KNOWN", "127.0.0.1"}};
    start();
    const std::string film = "1.2.840.10008.5.1.1.9";
    {
        const Client client(port());
        client.send(
            ScriptedAssociation::associationRequest({"PELLUCID", "KNOWN", {uid::capture, film}}));
        EXPECT_EQ(client.receive()[0], '\2');
    }
    m_listener.reset();
    ASSERT_EQ(m_ends.size(), 1U);
    ASSERT_TRUE(m_ends[0].refused);
    EXPECT_EQ(m_ends[0].refused->english(),
              "kinds of objects or encodings that this program does not take: "
              "BasicGrayscalePrintManagementMetaSOPClass in LittleEndianExplicit");
}

// Objects are refused while there is still room, before they are received.
TEST_F(PacsListener, AReserveOfTheDiskIsKept) {
    if (!isInstalled("storescu"))
        GTEST_SKIP() << "storescu is not installed";
    const fs::path first = series("L", 3, 32), second = series("M", 3, 32); // 3 kB each
    const SmallDisk disk(m_objects.folder(), "size=4m");
    if (!disk.isMounted())
        GTEST_SKIP() << "only root may mount a small disk";
    start();
    const auto send = [&](const fs::path &sent) {
        return run("storescu -v -R -aet KNOWN -aec PELLUCID +sd 127.0.0.1 " +
                   std::to_string(port()) + " '" + sent.string() + "'");
    };
    const auto leave = [&](const std::string &name, std::size_t bytes) {
        std::ofstream(m_objects.folder() / name)
            << std::string(fs::space(m_objects.folder()).available - bytes, 'x');
    };
    // The reserve of 5 % is 210 kB.
    leave("other", 400'000);
    EXPECT_EQ(send(first).exitCode, 0);
    const std::size_t here = filesIn(m_objects.folder()).size();
    EXPECT_EQ(here, 4U);
    leave("more", 150'000); // enough for the objects
    const auto refused = send(second);
    EXPECT_THAT(refused.out + refused.error, testing::HasSubstr("OutOfResources"));
    EXPECT_EQ(filesIn(m_objects.folder()).size(), here + 1);
    m_listener.reset();
    ASSERT_FALSE(m_refused.empty());
    for (const archive::RefusedObject &object : m_refused)
        EXPECT_TRUE(object.reason.is(because::diskIsAlmostFull)) << object.reason.english();
}

// Neither the output nor the memory of the command grows with what strangers do.
TEST_F(PacsListener, StrangersDoNotFillTheOutput) {
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        GTEST_SKIP() << "PELLUCID_CLI is not set";
    ::setenv("XDG_DATA_HOME", (m_folder / "data").c_str(), 1);
    archive::ServerList::ofUser().put({"known", archive::dicomPeer("KNOWN@127.0.0.1:104")});
    const int port = freePort();
    const fs::path output = m_folder / "output";
    std::jthread listening([&] {
        run("exec timeout -s INT 30 '" + std::string(cli) + "' listen --to '" +
            m_objects.folder().string() + "' --port " + std::to_string(port) + " >'" +
            output.string() + "' 2>&1 & echo $! >'" + (m_folder / "pid").string() + "'; wait");
    });
    for (int n = 0; n < 500 && !Client(port, "127.0.0.9").isConnected(); ++n)
        ::usleep(20000);
    for (int n = 0; n < 200; ++n)
        EXPECT_TRUE(Client(port, "127.0.0.9").isClosedWithin(10.0)) << n;
    ::kill(pid_t(std::atoi(readText(m_folder / "pid").c_str())), SIGINT);
    listening.join();
    ::unsetenv("XDG_DATA_HOME");
    const std::string printed = readText(output);
    EXPECT_THAT(printed, testing::HasSubstr("127.0.0.9"));
    EXPECT_LE(std::count(printed.begin(), printed.end(), '\n'), 3) << printed;
}

// With TLS, a receiver trusts only authorities that somebody has chosen.
TEST_F(PacsListener, TlsNeedsAuthorities) {
    m_options.usesTls = true;
    m_options.certificate = m_options.key = "/some.pem";
    try {
        start();
        ADD_FAILURE() << "it listens";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::usage);
        EXPECT_TRUE(error.reason().is(because::receiverNeedsAuthorities));
    }
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        return;
    writeText(m_folder / "file.pem", "");
    const std::string file = (m_folder / "file.pem").string();
    const auto result =
        run("'" + std::string(cli) + "' listen --certificate '" + file + "' --key '" + file + "'");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_THAT(result.error, testing::HasSubstr("--authorities"));
}

} // namespace pellucid
