// SPDX-License-Identifier: GPL-3.0-or-later
// Logging in to DICOMweb servers: a login server, a DICOMweb server and a browser, written without
// any library.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <poll.h>
#include <set>
#include <stop_token>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/archive/login.h"
#include "core/archive/pkce.h"
#include "core/archive/reasons.h"
#include "core/archive/retrieval.h"
#include "core/archive/search.h"
#include "core/archive/sending.h"
#include "core/network/client/reasons.h"
#include "core/network/process/reasons.h"
#include "core/task/error.h"
#include "tests/network/login_server.h"
#include "tests/network/pacs.h"

namespace pellucid {

using namespace test;
namespace because = task::because;

namespace {

// What the program may show, without what it must not.
void expectNoSecret(const std::string &text) {
    for (const char *const secret : {"access-token", "refresh-token", "the-code"})
        EXPECT_EQ(text.find(secret), std::string::npos) << text;
}

std::string reasonOf(const std::function<void()> &work) {
    try {
        work();
    } catch (const task::Error &error) {
        expectNoSecret(error.what());
        return error.reason().english();
    }
    return "nothing failed";
}

std::string english(const task::Reason &reason) {
    return reason.english();
}

class OAuth : public Pacs {
protected:
    void SetUp() override {
        m_server = {"Web", archive::webPeer(m_web.url())};
        m_server.peer.authentication = network::Authentication::oauth;
        // No test waits for them: they are for a loaded machine.
        m_server.peer.connectSeconds = 60.0;
        m_server.peer.silenceSeconds = 60.0;
        m_server.loginSettings.issuer = m_login.url();
        m_server.loginSettings.clientId = "pellucid";
        m_server.loginSettings.scope = "openid offline_access";
        m_server.login = std::make_shared<archive::Login>(
            m_server, "", [this](const std::string &token) { m_kept.push_back(token); });
    }

    // A user who logs in as soon as the browser has opened.
    archive::Login::OpenPage user() {
        return [this](const std::string &page) {
            m_page = page;
            m_login.expect(page);
            const Fields fields = fieldsOf(page.substr(page.find('?') + 1));
            m_shown = std::async(std::launch::async, [fields] {
                return visit(fields.at("redirect_uri") +
                             "?code=the-code&state=" + fields.at("state"));
            });
        };
    }
    void logIn() { m_server.login->logIn(user()); }

    Tokens m_tokens;
    LoginServer m_login{m_tokens};
    WebServer m_web{m_tokens};
    archive::Server m_server;
    std::vector<std::string> m_kept; ///< refresh tokens for the keychain
    std::string m_page;
    std::future<std::string> m_shown; ///< by the browser at the end
};

} // namespace

TEST_F(OAuth, TheWholeLoginGivesAToken) {
    archive::requireValid(m_server);
    logIn();
    // The page of the login server, with its own query kept.
    EXPECT_TRUE(m_page.starts_with(m_login.url() + "/authorize?policy=a&")) << m_page;
    Fields page = fieldsOf(m_page.substr(m_page.find('?') + 1));
    EXPECT_EQ(page["response_type"], "code");
    EXPECT_EQ(page["client_id"], "pellucid");
    EXPECT_EQ(page["scope"], "openid offline_access");
    EXPECT_EQ(page["code_challenge_method"], "S256");
    EXPECT_EQ(page["code_challenge"].size(), 43U);
    EXPECT_GE(page["state"].size(), 43U);
    EXPECT_TRUE(page["redirect_uri"].starts_with("http://127.0.0.1:")) << page["redirect_uri"];
    // The server has compared the challenge; the verifier was not in the page.
    const auto requests = m_login.tokenRequests();
    ASSERT_EQ(requests.size(), 1U);
    const std::string verifier = requests[0].at("code_verifier");
    EXPECT_GE(verifier.size(), 43U);
    EXPECT_LE(verifier.size(), 128U);
    EXPECT_EQ(m_page.find(verifier), std::string::npos);
    const std::string shown = m_shown.get();
    EXPECT_TRUE(shown.starts_with("HTTP/1.1 200")) << shown;
    EXPECT_NE(shown.find("can close this window"), std::string::npos) << shown;
    EXPECT_NE(shown.find("logged in"), std::string::npos) << shown;
    EXPECT_EQ(m_kept, std::vector<std::string>{m_login.refreshToken()});
    // The port is closed again, and the token is used.
    EXPECT_EQ(visit(page["redirect_uri"]), "no connection");
    const auto found = archive::search({m_server}, {});
    ASSERT_FALSE(found.outcomes.at(0).failure.has_value()) << found.outcomes[0].failure->english();
    EXPECT_EQ(found.entries.size(), 1U);
    EXPECT_EQ(m_web.refusals(), 0);
    // A second login has a new state and a new verifier.
    logIn();
    m_shown.get();
    Fields second = fieldsOf(m_page.substr(m_page.find('?') + 1));
    EXPECT_NE(second["state"], page["state"]);
    EXPECT_NE(second["code_challenge"], page["code_challenge"]);
}

// The addresses may also be given without an issuer.
TEST_F(OAuth, NoDescriptionIsNeeded) {
    m_server.loginSettings.issuer.clear();
    m_server.loginSettings.authorizationUrl = m_login.url() + "/authorize";
    m_server.loginSettings.tokenUrl = m_login.url() + "/token/";
    archive::requireValid(m_server);
    m_server.login = std::make_shared<archive::Login>(m_server);
    logIn();
    EXPECT_TRUE(m_page.starts_with(m_login.url() + "/authorize?client_id=")) << m_page;
    EXPECT_EQ(archive::search({m_server}, {}).entries.size(), 1U);
}

TEST_F(OAuth, ADescriptionOfAnotherServerIsRefused) {
    m_login.setIssuer("https://login.example.org");
    EXPECT_EQ(reasonOf([this] { logIn(); }),
              english(because::issuerIsAnother("https://login.example.org")));
    EXPECT_TRUE(m_page.empty());
}

// Any page or program on this computer can send a redirect, but does not know the state.
TEST_F(OAuth, AWrongStateIsRefusedAndTheRightOneStillAwaited) {
    std::vector<std::string> wrong;
    std::string right;
    const auto browser = [&](const std::string &page) {
        m_login.expect(page);
        m_shown = std::async(std::launch::async, [&, page] {
            Fields fields = fieldsOf(page.substr(page.find('?') + 1));
            const std::string at = fields["redirect_uri"], state = fields["state"];
            // Browsers open connections in advance.
            const int idle =
                connectTo(std::stoi(at.substr(std::string("http://127.0.0.1:").size())));
            for (const char *const query : {"?code=stolen&state=guessed", "?code=stolen",
                                            "favicon.ico", "?error=access_denied&state=guessed"})
                wrong.push_back(visit(at + query));
            wrong.push_back(visit(at + "?code=stolen&state=" + state + "x"));
            right = visit(at + "?code=the-code&state=" + state);
            ::close(idle);
            return std::string();
        });
    };
    m_server.login->logIn(browser);
    m_shown.get();
    ASSERT_EQ(wrong.size(), 5U);
    for (const std::string &shown : wrong) {
        EXPECT_TRUE(shown.starts_with("HTTP/1.1 400")) << shown;
        EXPECT_NE(shown.find("The login failed"), std::string::npos) << shown;
    }
    EXPECT_NE(right.find("logged in"), std::string::npos) << right;
    const auto requests = m_login.tokenRequests();
    ASSERT_EQ(requests.size(), 1U); // no stolen code was redeemed
    EXPECT_EQ(requests[0].at("code"), "the-code");
}

// Another user sees the state among the arguments of the browser, and would log this one in as
// himself.
TEST_F(OAuth, OnlyABrowserOfThisUserIsAnswered) {
    if (::geteuid() != 0)
        GTEST_SKIP() << "needs root to become another user";
    int stolen = -1;
    m_server.login->logIn([&](const std::string &page) {
        m_login.expect(page);
        m_shown = std::async(std::launch::async, [&stolen, page] {
            const Fields fields = fieldsOf(page.substr(page.find('?') + 1));
            const std::string to = fields.at("redirect_uri") + "?state=" + fields.at("state");
            const pid_t other = ::fork();
            if (other == 0)
                ::_exit(::setuid(65534) == 0 && visit(to + "&code=stolen").empty() ? 0 : 1);
            ::waitpid(other, &stolen, 0);
            return visit(to + "&code=the-code");
        });
    });
    EXPECT_NE(m_shown.get().find("200 OK"), std::string::npos);
    EXPECT_EQ(stolen, 0); // the other one got no answer
}

TEST_F(OAuth, ADeniedLoginIsReported) {
    const auto browser = [&](const std::string &page) {
        Fields fields = fieldsOf(page.substr(page.find('?') + 1));
        m_shown = std::async(std::launch::async, [fields] {
            return visit(fields.at("redirect_uri") +
                         "?error=access_denied&state=" + fields.at("state"));
        });
    };
    EXPECT_EQ(reasonOf([&] { m_server.login->logIn(browser); }), english(because::loginIsDenied));
    EXPECT_NE(m_shown.get().find("The login failed"), std::string::npos);
    EXPECT_FALSE(m_server.login->isLoggedIn());
    EXPECT_TRUE(m_login.tokenRequests().empty());
}

TEST_F(OAuth, ATokenThatIsAboutToExpireIsRenewedBeforeItIsUsed) {
    m_login.setLifetime(0); // unknown: used until it is refused
    logIn();
    EXPECT_TRUE(m_server.login->hasToken());
    m_login.setLifetime(1);
    logIn();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (m_server.login->hasToken() && std::chrono::steady_clock::now() < end)
        std::this_thread::yield();
    EXPECT_FALSE(m_server.login->hasToken());
    EXPECT_EQ(archive::search({m_server}, {}).entries.size(), 1U);
    EXPECT_EQ(m_web.refusals(), 0);
    EXPECT_EQ(m_login.tokenRequests().back().at("grant_type"), "refresh_token");
    EXPECT_EQ(m_kept.back(), m_login.refreshToken());
}

TEST_F(OAuth, ATokenThatExpiresIsRenewedInTheMiddleAndNothingIsLost) {
    logIn();
    m_web.expireEvery(7);
    const archive::RetrievalReport report = get(m_server, webStudy);
    EXPECT_TRUE(report.isComplete()) << report.missing.front().reason.english();
    EXPECT_EQ(report.state.received, std::size_t(objects));
    EXPECT_EQ(report.unwanted, 0U);
    EXPECT_EQ(m_web.sent().size(), std::size_t(objects)); // none was asked for twice
    EXPECT_EQ(filesIn(m_folder / "got").size(), std::size_t(objects));
    EXPECT_GT(m_web.refusals(), 0);
    // Connections share a token: one that is renewed is not renewed by the others, too.
    EXPECT_LE(m_tokens.issued(), 1 + objects / 7);
    EXPECT_GE(m_tokens.issued(), 2);
    // A search and a sending meet an expired token as well.
    m_tokens.expire();
    EXPECT_EQ(archive::search({m_server}, {}).entries.size(), 1U);
    m_web.expireEvery(3);
    const auto sending = archive::send(m_server, filesIn(m_folder / "got"));
    EXPECT_TRUE(sending.notSent.empty()) << sending.notSent.front().reason.english();
    EXPECT_EQ(sending.state.sent, std::size_t(objects));
    EXPECT_EQ(m_web.stored().size(), std::size_t(objects));
}

// A connection that learns late that its token is refused gets the one that another connection has
// renewed. The server may have ended that, too, after it has brought objects.
TEST_F(OAuth, ATokenThatAnotherConnectionHasUsedUpIsRenewed) {
    logIn();
    m_server.connections = 2;
    std::promise<void> late, other;
    const std::shared_future<void> beforeLate = late.get_future(), beforeOther = other.get_future();
    const auto refusal = [](const std::shared_future<void> &after) {
        return HttpAnswer{401, "text/plain", "", "", after};
    };
    int withFirst = 0, withSecond = 0;
    m_web.setScript([&](const HttpRequest &request) -> std::optional<HttpAnswer> {
        constexpr int objectsOfSecond = 3;
        const std::string token = request.header("authorization");
        if (token == "Bearer access-token-1") // the late one waits for its refusal
            return refusal(++withFirst == 1 ? beforeLate : std::shared_future<void>());
        if (token != "Bearer access-token-2" || ++withSecond <= objectsOfSecond)
            return std::nullopt;
        // The other one has used it up, and waits in turn, so that nothing more comes before the
        // late one meets the end of this token, too.
        if (withSecond == objectsOfSecond + 1) {
            late.set_value();
            return refusal(beforeOther);
        }
        if (withSecond == objectsOfSecond + 2)
            other.set_value();
        return refusal({});
    });
    const archive::RetrievalReport report = get(m_server, webStudy);
    m_web.setScript({});
    EXPECT_TRUE(report.isComplete()) << report.missing.front().reason.english();
    EXPECT_EQ(report.state.received, std::size_t(objects));
    EXPECT_EQ(m_web.sent().size(), std::size_t(objects));
    EXPECT_EQ(m_tokens.issued(), 3);
}

// A program that starts has only the refresh token of the keychain.
TEST_F(OAuth, AKeptRefreshTokenIsEnough) {
    logIn();
    m_tokens.expire();
    m_server.login = std::make_shared<archive::Login>(m_server, m_kept.back());
    EXPECT_TRUE(m_server.login->isLoggedIn());
    EXPECT_FALSE(m_server.login->hasToken());
    EXPECT_EQ(archive::search({m_server}, {}).entries.size(), 1U);
    EXPECT_EQ(m_web.refusals(), 0);
}

TEST_F(OAuth, ARefusedRefreshTokenMeansANewLoginAndWhatHasArrivedStays) {
    logIn();
    m_shown.get();
    m_server.connections = 2;
    m_web.expireEvery(10);
    m_login.refuseToRenew();
    EXPECT_EQ(reasonOf([this] { get(m_server, webStudy); }), english(because::loginHasExpired));
    EXPECT_FALSE(m_server.login->isLoggedIn());
    EXPECT_EQ(m_kept.back(), ""); // the keychain forgets it
    const std::size_t arrived = filesIn(m_folder / "got").size();
    EXPECT_GE(arrived, 10U);
    EXPECT_LT(arrived, std::size_t(objects));
    const auto found = archive::search({m_server}, {});
    ASSERT_TRUE(found.outcomes.at(0).failure.has_value());
    EXPECT_TRUE(found.outcomes[0].failure->is(because::loginHasExpired));
    EXPECT_EQ(found.outcomes[0].code, task::ErrorCode::unusable);
    EXPECT_EQ(reasonOf([this] { archive::send(m_server, filesIn(m_folder / "got")); }),
              english(because::loginHasExpired));
    // After a new login, only the rest comes.
    m_web.expireEvery(0);
    logIn();
    const archive::RetrievalReport rest = get(m_server, webStudy);
    EXPECT_TRUE(rest.isComplete());
    EXPECT_EQ(rest.state.present, arrived);
}

// A server that accepts no token at all is not asked forever.
TEST_F(OAuth, ATokenThatIsRefusedTwiceIsRefused) {
    logIn();
    m_tokens.expire();
    m_login.lie({200, "application/json",
                 R"({"access_token": "access-token-that-is-useless", "token_type": "Bearer",
                     "refresh_token": "refresh-token-1"})",
                 ""});
    const auto found = archive::search({m_server}, {});
    ASSERT_TRUE(found.outcomes.at(0).failure.has_value());
    EXPECT_TRUE(found.outcomes[0].failure->is(because::serverDoesNotAcceptTheLogin));
    EXPECT_EQ(m_web.refusals(), 2);
}

TEST_F(OAuth, TokensGoToTheirOwnHostOnly) {
    HttpServer stranger([](const HttpRequest &) { return HttpAnswer{}; });
    logIn();
    m_shown.get();
    m_web.moveTo(stranger.url());
    const auto found = archive::search({m_server}, {});
    ASSERT_TRUE(found.outcomes.at(0).failure.has_value());
    EXPECT_TRUE(found.outcomes[0].failure->is(because::serverPointsElsewhere))
        << found.outcomes[0].failure->english();
    // Nor does the code or a refresh token.
    m_login.lie({307, "text/plain", "", stranger.url() + "/token/"});
    EXPECT_EQ(reasonOf([this] { logIn(); }), english(because::serverPointsElsewhere));
    EXPECT_NE(m_shown.get().find("The login failed"), std::string::npos);
    EXPECT_EQ(reasonOf([this] { m_server.login->token({}, m_server.login->token()); }),
              english(because::serverPointsElsewhere));
    EXPECT_EQ(stranger.requestCount(), 0U);
}

TEST_F(OAuth, AnswersThatAreNoTokensAreRefused) {
    const auto token = [](const std::string &access, const std::string &rest) {
        return HttpAnswer{200, "application/json",
                          R"({"access_token": ")" + access + "\"" + rest + "}", ""};
    };
    const std::string bearer = R"(, "token_type": "Bearer")";
    const std::string noToken = english(because::loginAnswerHasNoToken);
    const std::vector<std::pair<HttpAnswer, std::string>> lies{
        {{200, "text/html", "<html>access-token-1</html>", ""}, noToken},
        {token("access-token-1", ""), noToken},
        {token("access-token-1\\r\\nX: y", bearer), noToken},
        {token("access-token-1" + std::string(20'000, 'a'), bearer), noToken},
        {token("access-token-1", bearer + R"(, "refresh_token": "refresh-token 1")"), noToken},
        {token("access-token-1" + std::string(1'000'000, 'a'), bearer),
         english(because::serverAnswerIsTooLong)},
        {{400, "application/json", R"({"error": "invalid_client"})", ""},
         english(because::loginIsRefused("invalid_client"))},
        {{400, "application/json", R"({"error": "access-token-1"})", ""},
         english(because::loginIsRefused("unknown error"))},
        {{404, "text/html", "access-token-1", ""}, english(because::serverAnswersHttp(404))},
    };
    for (const auto &[lie, reason] : lies) {
        m_login.lie(lie);
        EXPECT_EQ(reasonOf([this] { logIn(); }), reason);
        EXPECT_NE(m_shown.get().find("The login failed"), std::string::npos);
        EXPECT_FALSE(m_server.login->isLoggedIn());
    }
    EXPECT_TRUE(m_kept.empty());
    // A login server that is out of order is not a refusal.
    m_login.lie({503, "text/plain", "", ""});
    try {
        logIn();
        ADD_FAILURE() << "a login without a token";
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unreachable);
        EXPECT_NE(error.reason().english().find("the login server 127.0.0.1: "), std::string::npos);
        EXPECT_NE(error.reason().english().find("busy"), std::string::npos);
    }
}

TEST_F(OAuth, ALoginCanBeCancelledAndHasALimitOfTime) {
    std::string redirectUrl;
    std::stop_source stop;
    const auto cancel = [&](const std::string &page) {
        redirectUrl = fieldsOf(page.substr(page.find('?') + 1))["redirect_uri"];
        stop.request_stop(); // the user closes the dialog
    };
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THROW(m_server.login->logIn(cancel, task::Progress(stop.get_token())), task::Cancelled);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    EXPECT_EQ(visit(redirectUrl), "no connection");
    // A user who does nothing.
    EXPECT_EQ(reasonOf([&] { m_server.login->logIn([](const std::string &) {}, {}, {}, 1.0); }),
              english(because::loginTookTooLong(1)));
    EXPECT_FALSE(m_server.login->isLoggedIn());
}

// The command line prints the address, and waits.
TEST_F(OAuth, TheCommandLineLogsIn) {
    const char *const cli = std::getenv("PELLUCID_CLI");
    if (cli == nullptr)
        GTEST_SKIP() << "PELLUCID_CLI is not set";
    const std::string command = "XDG_DATA_HOME='" + m_folder.path().string() + "' '" + cli + "' ";
    struct Result {
        int exitCode = -1;
        std::string output;
    };
    const auto runWithBrowser = [&](const std::string &arguments) {
        FILE *const pipe = ::popen((command + arguments + " 2>&1 </dev/null").c_str(), "r");
        Result result;
        std::array<char, 4096> line{};
        while (std::fgets(line.data(), int(line.size()), pipe) != nullptr) {
            std::string text = line.data();
            result.output += text;
            if (!text.starts_with("http"))
                continue;
            text.pop_back();
            user()(text);
        }
        const int status = ::pclose(pipe);
        result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return result;
    };
    const std::string add = "server add web --web " + m_web.url() + " --login oauth --client-id ";
    EXPECT_EQ(runWithBrowser(add + "pellucid").exitCode, 2);
    EXPECT_EQ(runWithBrowser(add + "pellucid --issuer http://login.example.org").exitCode, 2);
    EXPECT_EQ(runWithBrowser(add + "'' --issuer " + m_login.url()).exitCode, 2);
    const Result added = runWithBrowser(add + "pellucid --issuer " + m_login.url());
    EXPECT_EQ(added.exitCode, 0) << added.output;
    const Result found = runWithBrowser("find web");
    EXPECT_EQ(found.exitCode, 0) << found.output;
    EXPECT_NE(found.output.find(webStudy), std::string::npos) << found.output;
    EXPECT_EQ(runWithBrowser("echo web").exitCode, 0);
    expectNoSecret(found.output);
    for (const fs::path &file : filesIn(m_folder.path()))
        expectNoSecret(readText(file));
    // One reason and exit code 3.
    m_login.lie({400, "application/json", R"({"error": "invalid_client"})", ""});
    const Result refused = runWithBrowser("find web");
    EXPECT_EQ(refused.exitCode, 3);
    EXPECT_NE(refused.output.find("pellucid-cli: web: " +
                                  english(because::loginIsRefused("invalid_client"))),
              std::string::npos)
        << refused.output;
}

} // namespace pellucid
