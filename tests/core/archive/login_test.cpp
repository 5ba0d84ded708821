// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/login.h"

#include <gtest/gtest.h>

#include <set>

#include "core/archive/pkce.h"
#include "core/archive/reasons.h"
#include "core/network/client/reasons.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::archive {

namespace because = task::because;

namespace {

Server serverWithLogin() {
    Server server{"Web", webPeer("https://pacs.example.org/dicom-web")};
    server.peer.authentication = network::Authentication::oauth;
    server.loginSettings.issuer = "https://login.example.org/realms/hospital";
    server.loginSettings.clientId = "pellucid";
    server.loginSettings.scope = "openid offline_access";
    return server;
}

template <int Places> bool isRefused(const Server &server, task::Because<Places> reason) {
    try {
        requireValid(server);
    } catch (const task::Error &error) {
        return error.code() == task::ErrorCode::usage && error.reason().is(reason);
    }
    return false;
}

} // namespace

// The vector of RFC 7636, appendix B.
TEST(Pkce, TheChallengeIsThatOfTheStandard) {
    EXPECT_EQ(codeChallenge("dBjftJeZ4CVP-mB92K27uhbUJU1p1r_wW1gFWFOEjXk"),
              "E9Melhoa2OwvFrEMTJguCHaoeK1t8URWbuGJSstw-cM");
}

TEST(Pkce, RandomTextsDifferAndHaveTheCharactersOfAVerifier) {
    std::set<std::string> texts;
    for (int n = 0; n < 100; ++n) {
        const std::string text = randomText(48);
        EXPECT_EQ(text.size(), 64U);
        EXPECT_EQ(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                         "0123456789-_"),
                  std::string::npos)
            << text;
        texts.insert(text);
    }
    EXPECT_EQ(texts.size(), 100U);
    EXPECT_EQ(randomText(32).size(), 43U);
}

TEST(LoginSettings, AddressesAreReadAsTheyAre) {
    const network::Peer peer = loginPeer("https://login.example.org/o/token/?policy=a");
    EXPECT_TRUE(peer.usesTls);
    EXPECT_EQ(peer.host, "login.example.org");
    EXPECT_EQ(peer.port, 443);
    EXPECT_EQ(peer.path, "/o/token/?policy=a");
    EXPECT_EQ(loginPeer("https://login.example.org:8443").path, "/");
    EXPECT_EQ(loginPeer("https://login.example.org?a=b").path, "/?a=b");
    EXPECT_EQ(loginPeer("http://127.0.0.1:8080/token").port, 8080);
    EXPECT_EQ(loginPeer("http://localhost/token").host, "localhost");
    for (const std::string &bad :
         {std::string(), std::string("login.example.org"), std::string("ftp://h/"),
          std::string("http://login.example.org/token"), std::string("http://127.0.0.1.evil.org/"),
          std::string("https://user:secret@h/token"), std::string("https://h/a#b"),
          std::string("https://h/a b"), std::string("https://h/a\r\nX: y"),
          std::string("https://h:0/"), "https://h/" + std::string(3000, 'a')})
        EXPECT_THROW(loginPeer(bad), task::Error) << bad;
}

TEST(LoginSettings, WhatIsWrongIsNamed) {
    EXPECT_NO_THROW(requireValid(serverWithLogin()));
    Server server = serverWithLogin();
    server.peer = dicomPeer("A@h");
    server.peer.authentication = network::Authentication::oauth;
    EXPECT_TRUE(isRefused(server, because::loginIsForDicomWeb));
    server = serverWithLogin();
    server.peer.usesTls = false;
    EXPECT_TRUE(isRefused(server, because::loginNeedsHttps));
    server.peer.host = "127.0.0.1";
    EXPECT_NO_THROW(requireValid(server));
    server = serverWithLogin();
    server.loginSettings.tokenUrl = "https://login.example.org/token";
    EXPECT_TRUE(isRefused(server, because::loginNeedsAddresses)); // and an issuer
    server.loginSettings.issuer.clear();
    EXPECT_TRUE(isRefused(server, because::loginNeedsAddresses)); // only one of two
    server.loginSettings.authorizationUrl = "http://login.example.org/authorize";
    EXPECT_TRUE(isRefused(server, because::isNoLoginAddress));
    server.loginSettings.authorizationUrl = "https://login.example.org/authorize?a=b";
    EXPECT_NO_THROW(requireValid(server));
    for (const char *const bad : {"", "a b", "a\n", "\xc3\xa4"}) {
        server.loginSettings.clientId = bad;
        EXPECT_TRUE(isRefused(server, because::isNoClientId)) << bad;
    }
    for (const char *const bad : {" ", "a\nb", "a \"b\"", "\xc3\xa4"}) {
        server = serverWithLogin();
        server.loginSettings.scope = bad;
        EXPECT_TRUE(isRefused(server, because::isNoScope)) << bad;
    }
}

TEST(LoginSettings, TheListKeepsThemWithoutTokens) {
    const test::TemporaryFolder folder;
    Server server = serverWithLogin();
    ServerList(folder / "servers.json").put(server);
    EXPECT_EQ(ServerList(folder / "servers.json").get("Web"), server);
    server.login = std::make_shared<Login>(server, "top secret");
    ServerList(folder / "servers.json").put(server);
    EXPECT_EQ(test::readText(folder / "servers.json").find("secret"), std::string::npos);
}

// Without a refresh token, nothing is asked of the network.
TEST(Login, WhoHasNotLoggedInHasNoToken) {
    const Server server = serverWithLogin();
    Login login(server);
    EXPECT_FALSE(login.isLoggedIn());
    EXPECT_FALSE(login.hasToken());
    try {
        login.token();
        ADD_FAILURE() << "a token without a login";
    } catch (const task::Error &error) {
        EXPECT_TRUE(error.reason().is(because::loginHasExpired));
    }
    EXPECT_THROW(authenticated(server, {}), task::Error);
    std::vector<std::string> kept;
    Login earlier(server, "refresh", [&](const std::string &token) { kept.push_back(token); });
    EXPECT_TRUE(earlier.isLoggedIn());
    EXPECT_FALSE(earlier.hasToken());
    earlier.forget();
    EXPECT_FALSE(earlier.isLoggedIn());
    EXPECT_EQ(kept, std::vector<std::string>{""});
}

} // namespace pellucid::archive
