// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/server.h"

#include <gtest/gtest.h>

#include "core/archive/search.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"
#include "core/task/error.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace {

std::string refusalOf(const SearchTerms &terms) {
    try {
        queryOf(terms, 0);
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::usage);
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST(Server, AddressesAreReadAndWritten) {
    const network::Peer dicom = dicomPeer("ARCHIVE@pacs.example.org:4242");
    EXPECT_EQ(dicom.calledAe, "ARCHIVE");
    EXPECT_EQ(dicom.host, "pacs.example.org");
    EXPECT_EQ(dicom.port, 4242);
    EXPECT_EQ(addressOf(dicom), "ARCHIVE@pacs.example.org:4242");
    EXPECT_EQ(dicomPeer("A@h").port, 104);
    const network::Peer web = webPeer("https://pacs.example.org/dicom-web/");
    EXPECT_TRUE(web.usesTls);
    EXPECT_EQ(web.port, 443);
    EXPECT_EQ(web.path, "/dicom-web");
    EXPECT_EQ(addressOf(web), "https://pacs.example.org/dicom-web");
    EXPECT_EQ(addressOf(webPeer("http://h:8042/wado")), "http://h:8042/wado");
    for (const char *const bad : {"", "host:104", "@host", "AE@", "AE@host:0", "AE@host:99999",
                                  "AE@host:x", "SEVENTEENLETTERS_@h", "A\\B@h", "A@h/x"})
        EXPECT_THROW(dicomPeer(bad), task::Error) << bad;
    for (const char *const bad : {"", "ftp://h", "h/dicom-web", "https://user:secret@h/dicom-web",
                                  "https://", "https://h:0/", "https://h/a?b"})
        EXPECT_THROW(webPeer(bad), task::Error) << bad;
}

TEST(Server, TheListIsKeptWithoutSecrets) {
    const test::TemporaryFolder folder;
    Server server{"Archive", dicomPeer("A@h:11112")};
    server.peer.usesTls = true;
    server.peer.authorities = "/ca.pem";
    server.peer.certificate = "/our.pem";
    server.peer.key = "/our.key";
    server.peer.authentication = network::Authentication::basic;
    server.peer.user = "eva";
    server.peer.secret = "top secret";
    server.peer.keyPassword = "also secret";
    server.retrieve = RetrieveMethod::move;
    server.limit = 7;
    {
        ServerList list(folder / "servers.json");
        list.put(server);
        list.put({"Web", webPeer("https://h/dicom-web")});
    }
    const std::string text = test::readText(folder / "servers.json");
    EXPECT_EQ(text.find("secret"), std::string::npos);
    ServerList list(folder / "servers.json");
    server.peer.secret.clear();
    server.peer.keyPassword.clear();
    EXPECT_EQ(list.get("Archive"), server);
    EXPECT_EQ(addressOf(list.get("Web").peer), "https://h/dicom-web");
    list.remove("Web");
    EXPECT_EQ(ServerList(folder / "servers.json").servers().size(), 1U);
    EXPECT_THROW(list.remove("Web"), task::Error);
}

// Neither on saving nor on connecting, unless the user allows it for the server.
TEST(Server, ALoginThatOthersCanReadIsRefused) {
    const test::TemporaryFolder folder;
    const auto refusal = [](auto &&work) -> std::string {
        try {
            work();
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::usage);
            return error.reason().is(task::because::loginCanBeRead) ? "can be read" : error.what();
        }
        return "allowed";
    };
    const auto put = [&](const Server &server) {
        return refusal([&] { ServerList(folder / "servers.json").put(server); });
    };
    using network::Authentication;
    for (const auto authentication : {Authentication::basic, Authentication::bearer}) {
        for (const char *const url :
             {"http://192.0.2.1/dicom-web", "http://pacs.example.org:8042", "http://126.0.0.1",
              "http://127.0.0.1.example.org", "http://localhost.example.org"}) {
            Server server{"s", webPeer(url)};
            server.peer.authentication = authentication;
            EXPECT_EQ(put(server), "can be read") << url;
            EXPECT_EQ(refusal([&] {
                          network::Link(network::Connection{server.peer, network::Purpose::echo});
                      }),
                      "can be read")
                << url;
        }
        for (const char *const url : {"https://192.0.2.1/dicom-web", "http://127.0.0.1:8042",
                                      "http://127.8.9.10", "http://localhost:8042"}) {
            Server server{"s", webPeer(url)};
            server.peer.authentication = authentication;
            EXPECT_EQ(put(server), "allowed") << url;
        }
    }
    Server server{"s", dicomPeer("A@pacs.example.org")};
    EXPECT_EQ(put(server), "allowed"); // no login
    server.peer.authentication = Authentication::basic;
    EXPECT_EQ(put(server), "can be read");
    server.peer.usesTls = true;
    EXPECT_EQ(put(server), "allowed");
    server.peer.usesTls = false;
    server.peer.allowsInsecureLogin = true;
    EXPECT_EQ(put(server), "allowed");
    EXPECT_EQ(ServerList(folder / "servers.json").get("s"), server);
    // Never for a login in the browser.
    server.peer = webPeer("http://192.0.2.1/dicom-web");
    server.peer.authentication = Authentication::oauth;
    server.peer.allowsInsecureLogin = true;
    EXPECT_NE(put(server), "allowed");
}

TEST(Server, ADamagedListNamesThePlace) {
    const test::TemporaryFolder folder;
    const auto message = [&](const std::string &text) {
        test::writeText(folder / "servers.json", text);
        try {
            const ServerList list(folder / "servers.json");
        } catch (const task::Error &error) {
            return std::string(error.what());
        }
        return std::string("read");
    };
    EXPECT_NE(message("{").find("servers.json"), std::string::npos);
    EXPECT_NE(
        message(R"({"schema": "pellucid-servers/1", "servers": [{"name": "a", "address": "x"}]})")
            .find("/servers/0/address"),
        std::string::npos);
    EXPECT_EQ(message(R"({"schema": "pellucid-servers/1", "servers": []})"), "read");
}

TEST(Search, TermsAreChecked) {
    const auto isRefused = [](const SearchTerms &terms) { return refusalOf(terms) != "accepted"; };
    EXPECT_TRUE(isRefused({.patientName = "a\\b"}));
    EXPECT_TRUE(isRefused({.date = "2026"}));
    EXPECT_TRUE(isRefused({.date = "-"}));
    EXPECT_TRUE(isRefused({.studyUid = "x"}));
    EXPECT_TRUE(isRefused({.level = network::Level::series}));
    EXPECT_TRUE(isRefused({.studyUid = "1.2", .level = network::Level::image}));
    EXPECT_FALSE(isRefused({.patientName = "M*ller^E?a", .date = "20260101-"}));
    EXPECT_FALSE(isRefused({.date = "-20260101"}));
    EXPECT_FALSE(isRefused({.date = "20240229"}));
    EXPECT_FALSE(isRefused({.date = "20260101-20260101"}));
}

TEST(Search, DatesAreOfTheCalendar) {
    EXPECT_EQ(refusalOf({.date = "20261399"}), "'20261399' is not a calendar date");
    EXPECT_EQ(refusalOf({.date = "20260101-20260231"}), "'20260231' is not a calendar date");
    EXPECT_EQ(refusalOf({.date = "20250229-"}), "'20250229' is not a calendar date");
    EXPECT_EQ(refusalOf({.date = "20260102-20260101"}),
              "the range of dates '20260102-20260101' ends before it begins");
    EXPECT_NE(refusalOf({.date = "20260101-20260102-20260103"}), "accepted");
}

// A server ignores what does not belong to the level.
TEST(Search, TermsOfOtherLevelsAreRefused) {
    using network::Level;
    EXPECT_EQ(refusalOf({.patientName = "A", .studyUid = "1.2", .level = Level::series}),
              "--name does not apply to a search at the level 'series'");
    EXPECT_EQ(refusalOf({.date = "20260101", .level = Level::series}),
              "--date does not apply to a search at the level 'series'");
    EXPECT_EQ(
        refusalOf(
            {.modality = "CT", .studyUid = "1.2", .level = Level::image, .seriesUid = "1.2.3"}),
        "--modality does not apply to a search at the level 'image'");
    EXPECT_EQ(refusalOf({.seriesUid = "1.2.3"}),
              "--series does not apply to a search at the level 'study'");
    EXPECT_EQ(
        refusalOf(
            {.modality = "CT", .studyUid = "1.2", .level = Level::series, .seriesUid = "1.2.3"}),
        "accepted");
}

TEST(Search, TextsAreUtf8) {
    EXPECT_EQ(refusalOf({.patientName = "M\u00FCller"}), "accepted");
    EXPECT_NE(refusalOf({.patientName = "M\xFCller"}).find("not encoded in UTF-8"),
              std::string::npos);
    EXPECT_NE(refusalOf({.patientId = "\xC0\xAF"}).find("not encoded in UTF-8"), std::string::npos);
}

} // namespace pellucid::archive
