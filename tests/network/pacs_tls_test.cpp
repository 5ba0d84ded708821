// SPDX-License-Identifier: GPL-3.0-or-later
// TLS of DICOM connections, with servers that have the right certificate and with others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <variant>
#include <vector>

#include "core/archive/listener.h"
#include "core/network/client/link.h"
#include "core/task/error.h"
#include "tests/network/pacs.h"
#include "tests/support/command.h"
#include "tests/support/files.h"

namespace pellucid {

using namespace test;

namespace {

// The bytes of a question or an answer in what one side sends by TLS (RFC 5246, 6.2).
std::size_t applicationBytesIn(const std::string &records) {
    constexpr unsigned char applicationData = 23;
    const auto byte = [&](std::size_t at) { return std::size_t((unsigned char)(records[at])); };
    std::size_t count = 0;
    for (std::size_t at = 0; at + 5 <= records.size();) {
        const std::size_t length = byte(at + 3) << 8 | byte(at + 4);
        if (byte(at) == applicationData)
            count += length;
        at += 5 + length;
    }
    return count;
}

// A ClientHello (RFC 8446, 4.1.2).
struct Offer {
    std::set<int> ciphers, compressions, versions;
};

Offer offerIn(const std::string &bytes) {
    const auto number = [&](std::size_t at, int count) {
        int value = 0;
        for (int n = 0; n < count; ++n)
            value = value << 8 | int((unsigned char)(bytes.at(at + std::size_t(n))));
        return value;
    };
    Offer offer;
    std::size_t at = 5 + 4 + 2 + 32;      // headers of record and message, version, random
    at += 1 + std::size_t(number(at, 1)); // session
    const auto numbers = [&](int lengthBytes, int size, std::set<int> &into) {
        const std::size_t end = at + std::size_t(lengthBytes + number(at, lengthBytes));
        for (at += std::size_t(lengthBytes); at < end; at += std::size_t(size))
            into.insert(number(at, size));
    };
    numbers(2, 2, offer.ciphers);
    numbers(1, 1, offer.compressions);
    constexpr int supportedVersions = 43;
    const std::size_t end = at + 2 + std::size_t(number(at, 2));
    for (at += 2; at < end;) {
        const int type = number(at, 2), length = number(at + 2, 2);
        at += 4;
        const std::size_t next = at + std::size_t(length);
        if (type == supportedVersions)
            numbers(1, 2, offer.versions);
        at = next;
    }
    return offer;
}

class NoObjects : public network::Receiver {
public:
    std::variant<platform::HandleView, std::uint16_t> open(const network::Arrival &) override {
        return network::status::outOfResources;
    }
    std::uint16_t keep(const network::Arrival &, std::uint64_t) override {
        return network::status::outOfResources;
    }
};

// Certificates of an authority of our own, made for the test.
class PacsTls : public Pacs {
protected:
    void SetUp() override {
        Pacs::SetUp();
        if (!test::isInstalled("openssl"))
            GTEST_SKIP() << "openssl is not installed";
        shell("openssl req -x509 -newkey rsa:2048 -nodes -keyout ca.key -out ca.pem -days 30 -subj "
              "'/CN=Test CA' -addext basicConstraints=critical,CA:TRUE");
        shell("openssl req -x509 -newkey rsa:2048 -nodes -keyout ca2.key -out ca2.pem -days 30 "
              "-subj '/CN=Other CA' -addext basicConstraints=critical,CA:TRUE");
        certificate("good", "IP:127.0.0.1", "-days 30");
        certificate("wrong", "DNS:other.example.org", "-days 30");
        certificate("client", "DNS:client", "-days 30");
        // Valid for a day, ten days ago.
        certificate("old", "IP:127.0.0.1",
                    "-not_before 20200101000000Z -not_after 20200102000000Z");
    }
    void shell(const std::string &command) {
        const auto result = test::run("cd '" + m_folder.path().string() + "' && " + command);
        ASSERT_EQ(result.exitCode, 0) << command << result.error;
    }
    void certificate(const std::string &name, const std::string &host,
                     const std::string &validity) {
        test::writeText(m_folder / (name + ".ext"), "subjectAltName=" + host + "\n");
        shell("openssl req -newkey rsa:2048 -nodes -keyout " + name + ".key -out " + name +
              ".csr -subj '/CN=" + name + "'");
        if (validity.find("not_before") == std::string::npos) {
            shell("openssl x509 -req -in " + name +
                  ".csr -CA ca.pem -CAkey ca.key -CAcreateserial -out " + name + ".pem -extfile " +
                  name + ".ext " + validity);
            return;
        }
        // openssl x509 cannot set a date in the past, openssl ca can.
        test::writeText(m_folder / "index.txt", "");
        test::writeText(m_folder / "serial", "01\n");
        test::writeText(
            m_folder / "ca.cnf",
            "[ca]\ndefault_ca=d\n[d]\ndatabase=index.txt\nserial=serial\nnew_certs_dir=.\n"
            "default_md=sha256\npolicy=p\nrand_serial=no\n[p]\ncommonName=supplied\n");
        shell("openssl ca -batch -config ca.cnf -cert ca.pem -keyfile ca.key -in " + name +
              ".csr -out " + name +
              ".pem -startdate 20200101000000Z -enddate 20200102000000Z "
              "-extfile " +
              name + ".ext");
    }
    std::string at(const std::string &name) const { return (m_folder / name).string(); }

    // A storage server, which answers C-ECHO.
    std::unique_ptr<test::Server> server(const std::string &name, bool requiresClient = false) {
        const int port = test::freePort();
        return std::make_unique<test::Server>(
            std::vector<std::string>{"storescp", "+tls", at(name + ".key"), at(name + ".pem"),
                                     requiresClient ? "-rc" : "-ic", "+cf", at("ca.pem"), "-od",
                                     m_folder.path().string(), std::to_string(port)},
            port);
    }
    archive::Server client(int port) const {
        archive::Server server = serverAt(port, "COMMON");
        server.peer.usesTls = true;
        server.peer.authorities = at("ca.pem");
        return server;
    }
    // As DCMTK's echoscu, which shows a certificate. *Shape*: the reason that the receiver gives.
    std::string receivedFrom(const std::string &name, const archive::ListenerOptions &options) {
        std::vector<archive::ConnectionEnd> ends;
        std::optional<archive::Listener> listener(
            std::in_place, options, [] { return std::make_unique<NoObjects>(); },
            archive::ListenerObserver{
                [&](const archive::ConnectionEnd &end) { ends.push_back(end); }});
        const std::string client =
            name.empty() ? "+tla" : "+tls '" + at(name + ".key") + "' '" + at(name + ".pem") + "'";
        const int exitCode =
            test::run("echoscu " + client + " +cf '" + at("ca.pem") +
                      "' -aet KNOWN -aec PELLUCID 127.0.0.1 " + std::to_string(listener->port()))
                .exitCode;
        listener.reset();
        EXPECT_EQ(ends.size(), 1U);
        EXPECT_EQ(exitCode == 0, !ends.at(0).reason.has_value());
        return ends.at(0).reason ? ends[0].reason->english() : "accepted";
    }
    archive::ListenerOptions receiver(const std::string &host) const {
        archive::ListenerOptions options;
        options.port = 0;
        options.senders = {{"KNOWN", host}};
        options.usesTls = true;
        options.certificate = at("good.pem");
        options.key = at("good.key");
        options.authorities = at("ca.pem");
        return options;
    }
    static std::string echo(const archive::Server &server) {
        return failureOf([&] {
            network::Link link(network::Connection{server.peer, network::Purpose::echo});
            link.echo();
        });
    }
};

} // namespace

TEST_F(PacsTls, ObjectsComeOverTls) {
    if (!test::isInstalled("Orthanc"))
        GTEST_SKIP() << "Orthanc is not installed";
    test::Orthanc orthanc(", \"DicomTlsEnabled\": true, \"DicomTlsCertificate\": \"" +
                          at("good.pem") + "\", \"DicomTlsPrivateKey\": \"" + at("good.key") +
                          "\", \"DicomTlsTrustedCertificates\": \"" + at("ca.pem") + "\"");
    archive::Server secure = client(orthanc.port());
    secure.peer.calledAe = "ORTHANC";
    // Orthanc wants a certificate of ours.
    EXPECT_NE(echo(secure), "nothing failed");
    secure.peer.certificate = at("client.pem");
    secure.peer.key = at("client.key");
    std::string parameters;
    network::Link link(network::Connection{secure.peer, network::Purpose::echo}, {},
                       [&](network::Step step, const std::string &found) {
                           if (step == network::Step::tls)
                               parameters = found;
                       });
    EXPECT_TRUE(parameters.starts_with("TLSv1.")) << parameters;
    const fs::path sent = series("T", 12);
    put(secure, sent);
    EXPECT_TRUE(get(secure, studyIn(sent)).isComplete());
    EXPECT_EQ(dataSetsIn(m_folder / "got"), dataSetsIn(sent));
}

// No byte of a question is sent to a server that is not the right one, and the user learns why.
TEST_F(PacsTls, WrongServersAreRefusedAndNamed) {
    using testing::HasSubstr;
    {
        const auto storescp = server("wrong");
        EXPECT_THAT(echo(client(storescp->port())), HasSubstr("IP address mismatch"));
    }
    {
        const auto storescp = server("old");
        EXPECT_THAT(echo(client(storescp->port())), HasSubstr("expired"));
    }
    {
        const auto storescp = server("good");
        archive::Server stranger = client(storescp->port());
        stranger.peer.authorities = at("ca2.pem");
        EXPECT_THAT(echo(stranger), HasSubstr("--authorities"));
        stranger.peer.authorities = at("missing.pem");
        EXPECT_THROW(network::Link(network::Connection{stranger.peer, network::Purpose::echo}),
                     task::Error);
        // A client that speaks no TLS.
        archive::Server plain = serverAt(storescp->port(), "COMMON");
        EXPECT_THAT(echo(plain), HasSubstr("perhaps it expects TLS"));
    }
    {
        const auto storescp = server("good", true);
        archive::Server without = client(storescp->port());
        EXPECT_NE(echo(without), "nothing failed");
        without.peer.certificate = at("client.pem");
        without.peer.key = at("client.key");
        EXPECT_EQ(echo(without), "nothing failed");
        without.peer.key = at("good.key");
        EXPECT_THROW(network::Link(network::Connection{without.peer, network::Purpose::echo}),
                     task::Error);
    }
    { // A server that speaks no TLS.
        test::Dcmqrscp plain;
        archive::Server secure = client(plain.port());
        secure.peer.silenceSeconds = 3.0;
        EXPECT_THAT(echo(secure), HasSubstr("does not speak TLS"));
    }
    for (const bool demands : {false, true}) {
        const int port = test::freePort();
        std::vector<std::string> command{
            "openssl", "s_server",     "-accept", "127.0.0.1:" + std::to_string(port),
            "-cert",   at("good.pem"), "-key",    at("good.key"),
            "-www"};
        if (demands)
            command.insert(command.end(), {"-Verify", "1", "-CAfile", at("ca.pem")});
        const test::Server openssl(command, port);
        archive::Server program = client(port);
        program.peer.protocol = network::Protocol::web;
        if (!demands)
            program.peer.authorities = at("ca2.pem");
        EXPECT_THAT(echo(program),
                    HasSubstr(demands ? "requires a client certificate" : "--authorities"));
    }
}

// Servers that know only what is too old: the reason names the protocol, and not a byte of the
// question leaves this computer.
TEST_F(PacsTls, ProtocolsThatAreTooOldAreRefused) {
    using testing::HasSubstr;
    // Debian's openssl offers them at security level 0 only.
    const auto serve = [&](const std::string &protocol) {
        const int port = test::freePort();
        return std::make_unique<test::Server>(
            std::vector<std::string>{"openssl", "s_server", protocol, "-cipher", "ALL:@SECLEVEL=0",
                                     "-accept", "127.0.0.1:" + std::to_string(port), "-cert",
                                     at("good.pem"), "-key", at("good.key"), "-www"},
            port);
    };
    for (const char *const old : {"-tls1_1", "-tls1"}) {
        const auto server = serve(old);
        test::Proxy proxy(server->port());
        const std::string reason = echo(client(proxy.port()));
        EXPECT_THAT(reason, HasSubstr("protocol")) << old;
        EXPECT_GT(proxy.fromProgram().size(), 0U);
        EXPECT_EQ(applicationBytesIn(proxy.fromProgram()), 0U) << old;
    }
    // The count does count: here the question is sent, to a server that is no DICOM server.
    const auto server = serve("-tls1_2");
    test::Proxy proxy(server->port());
    archive::Server current = client(proxy.port());
    current.peer.associationSeconds = 2.0;
    EXPECT_NE(echo(current), "nothing failed");
    EXPECT_GT(applicationBytesIn(proxy.fromProgram()), 0U);
}

// It does speak TLS, and says what is wrong.
TEST_F(PacsTls, AServerWithoutACommonCipherIsNamed) {
    const int port = test::freePort();
    const test::Server server({"openssl", "s_server", "-tls1_2", "-cipher",
                               "AES128-SHA:@SECLEVEL=0", "-accept",
                               "127.0.0.1:" + std::to_string(port), "-cert", at("good.pem"), "-key",
                               at("good.key"), "-www"},
                              port);
    EXPECT_THAT(echo(client(port)), testing::HasSubstr("handshake failure"));
}

// What this program offers (PS3.15, B.12; RFC 9325, 4.2), to both kinds of servers.
TEST_F(PacsTls, TheOfferFollowsTheProfile) {
    const std::set<int> tls13{0x1301, 0x1302, 0x1303}, tls12{0xc02b, 0xc02c, 0xc02f, 0xc030};
    constexpr int secureRenegotiation = 0x00ff; // a signal, no cipher
    for (const bool isWeb : {false, true}) {
        SCOPED_TRACE(isWeb);
        const int port = test::freePort();
        const test::Server server({"openssl", "s_server", "-accept",
                                   "127.0.0.1:" + std::to_string(port), "-cert", at("good.pem"),
                                   "-key", at("good.key"), "-www"},
                                  port);
        test::Proxy proxy(port);
        archive::Server program = client(proxy.port());
        if (isWeb)
            program.peer.protocol = network::Protocol::web;
        program.peer.associationSeconds = program.peer.silenceSeconds = 1.0;
        EXPECT_THROW(
            network::Link(network::Connection{program.peer, network::Purpose::echo}).echo(),
            task::Error); // it is no server of this kind
        const Offer offer = offerIn(proxy.fromProgram());
        std::set<int> ciphers = offer.ciphers;
        ciphers.erase(secureRenegotiation);
        std::set<int> all = tls12;
        all.insert(tls13.begin(), tls13.end());
        EXPECT_EQ(ciphers, all);
        EXPECT_EQ(offer.versions, (std::set<int>{0x0303, 0x0304}));
        EXPECT_EQ(offer.compressions, std::set<int>{0});
    }
}

// Neither a key exchange without forward secrecy nor a cipher without authentication.
TEST_F(PacsTls, WeakServersAreRefused) {
    for (const char *const weak :
         {"AES128-GCM-SHA256", "ECDHE-RSA-AES128-SHA256", "DHE-RSA-AES128-GCM-SHA256",
          "ECDHE-RSA-AES256-SHA", "ECDHE-RSA-AES128-GCM-SHA256"}) {
        const int port = test::freePort();
        const test::Server server({"openssl", "s_server", "-tls1_2", "-cipher",
                                   weak + std::string(":@SECLEVEL=0"), "-accept",
                                   "127.0.0.1:" + std::to_string(port), "-cert", at("good.pem"),
                                   "-key", at("good.key"), "-www"},
                                  port);
        const bool isFine = weak == std::string("ECDHE-RSA-AES128-GCM-SHA256");
        for (const bool isWeb : {false, true}) {
            archive::Server program = client(port);
            if (isWeb)
                program.peer.protocol = network::Protocol::web;
            program.peer.associationSeconds = program.peer.silenceSeconds = 1.0;
            std::string parameters, failure = "nothing failed";
            try {
                network::Link link(network::Connection{program.peer, network::Purpose::echo}, {},
                                   [&](network::Step step, const std::string &found) {
                                       if (step == network::Step::tls)
                                           parameters = found;
                                   });
                link.echo();
            } catch (const task::Error &error) { // it is no DICOM server either
                failure = error.reason().english();
            }
            if (isFine && !isWeb) {
                EXPECT_THAT(parameters, testing::HasSubstr(weak));
            }
            EXPECT_EQ(failure.find("handshake failure") == std::string::npos, isFine)
                << weak << (isWeb ? " web: " : ": ") << failure;
        }
    }
}

// And what it accepts as a server.
TEST_F(PacsTls, TheReceiverFollowsTheProfile) {
    archive::ListenerOptions options = receiver("127.0.0.1");
    options.negotiationSeconds = 2.0;
    const archive::Listener listener(options, [] { return std::make_unique<NoObjects>(); });
    const auto connects = [&](const std::string &with) {
        const auto result =
            test::run("openssl s_client -connect 127.0.0.1:" + std::to_string(listener.port()) +
                      " -cert '" + at("good.pem") + "' -key '" + at("good.key") + "' -CAfile '" +
                      at("ca.pem") + "' " + with);
        return result.out.find("Verify return code: 0 (ok)") != std::string::npos &&
               result.out.find("Cipher is (NONE)") == std::string::npos;
    };
    for (const char *const good :
         {"-tls1_3", "-tls1_2", "-tls1_2 -cipher ECDHE-RSA-AES256-GCM-SHA384",
          "-tls1_2 -cipher ECDHE-RSA-AES128-GCM-SHA256"})
        EXPECT_TRUE(connects(good)) << good;
    for (const char *const bad :
         {"-tls1_1 -cipher ALL:@SECLEVEL=0", "-tls1_2 -cipher AES128-GCM-SHA256",
          "-tls1_2 -cipher DHE-RSA-AES128-GCM-SHA256", "-tls1_2 -cipher ECDHE-RSA-AES128-SHA256",
          "-tls1_2 -cipher ECDHE-RSA-AES128-SHA:@SECLEVEL=0"})
        EXPECT_FALSE(connects(bad)) << bad;
}

// A sender's certificate must be from the authorities that are named, and name the sender.
TEST_F(PacsTls, SendersShowTheirOwnCertificates) {
    using testing::AllOf;
    using testing::HasSubstr;
    if (!test::isInstalled("echoscu"))
        GTEST_SKIP() << "echoscu is not installed";
    certificate("named", "DNS:localhost", "-days 30");
    certificate("127.0.0.1", "DNS:elsewhere.example.org", "-days 30"); // its common name
    shell("openssl x509 -req -in 127.0.0.1.csr -CA ca.pem -CAkey ca.key -CAcreateserial -out "
          "bare.pem -days 30 && cp 127.0.0.1.key bare.key");
    shell("openssl x509 -req -in good.csr -CA ca2.pem -CAkey ca2.key -CAcreateserial -out "
          "foreign.pem -extfile good.ext -days 30 && cp good.key foreign.key");
    const archive::ListenerOptions numbered = receiver("127.0.0.1"), named = receiver("localhost");
    EXPECT_EQ(receivedFrom("good", numbered), "accepted"); // its address
    EXPECT_EQ(receivedFrom("good", named), "accepted");
    EXPECT_EQ(receivedFrom("named", named), "accepted");   // its name, as the user entered it
    EXPECT_EQ(receivedFrom("bare", numbered), "accepted"); // only a common name
    EXPECT_THAT(receivedFrom("named", numbered),
                AllOf(HasSubstr("localhost"), HasSubstr("127.0.0.1")));
    EXPECT_THAT(receivedFrom("client", named),
                AllOf(HasSubstr("names client"), HasSubstr("localhost")));
    EXPECT_THAT(receivedFrom("127.0.0.1", numbered), HasSubstr("elsewhere.example.org"));
    EXPECT_NE(receivedFrom("foreign", numbered), "accepted");
    EXPECT_NE(receivedFrom("", numbered), "accepted");
    archive::ListenerOptions anyone = numbered;
    anyone.acceptsAnyone = true;
    EXPECT_EQ(receivedFrom("client", anyone), "accepted");
    EXPECT_NE(receivedFrom("foreign", anyone), "accepted");
}

// A server, or somebody before it, that answers with TLS 1.1 although it was offered TLS 1.2 and
// 1.3.
TEST_F(PacsTls, ADowngradeIsRefused) {
    int port = 0;
    const int listening = test::listenOn(port);
    std::string received;
    std::jthread peer([&] {
        const int client = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
        std::string buffer(1 << 14, '\0');
        if (::recv(client, buffer.data(), buffer.size(), 0) <= 0) // its ClientHello
            return;
        // ServerHello: TLS 1.1, a random number, no session, ECDHE-RSA-AES128-SHA, no compression.
        const std::string hello = std::string("\x02\0\0\x26\x03\x02", 6) + std::string(32, '\x5a') +
                                  std::string("\0\xc0\x13\0", 4);
        const std::string record = std::string("\x16\x03\x02\0\x2a", 5) + hello;
        ::send(client, record.data(), record.size(), MSG_NOSIGNAL);
        for (ssize_t got = 0; (got = ::recv(client, buffer.data(), buffer.size(), 0)) > 0;)
            received.append(buffer, 0, std::size_t(got));
        ::close(client);
    });
    const std::string reason = echo(client(port));
    peer.join();
    ::close(listening);
    EXPECT_THAT(reason,
                testing::AnyOf(testing::HasSubstr("protocol"), testing::HasSubstr("version")));
    // An alert at most.
    EXPECT_EQ(applicationBytesIn(received), 0U);
    EXPECT_LE(received.size(), 7U);
    EXPECT_EQ(received.find("PELLUCID"), std::string::npos);
}

} // namespace pellucid
