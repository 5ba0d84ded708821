// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/redirect.h"

#include <gtest/gtest.h>

#include "core/network/process/login_json.h"
#include "core/network/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::network::process {

namespace because = task::because;

namespace {

std::optional<LoginResult> resultOf(const std::string &target) {
    return loginResultOf("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", "the state");
}

template <class Read> std::string refusalOf(Read &&read, const std::string &text) {
    try {
        read(text);
    } catch (const task::Error &error) {
        EXPECT_EQ(error.code(), task::ErrorCode::unusable);
        return error.reason().english();
    }
    return "nothing";
}

} // namespace

TEST(Redirect, TheCodeIsReadWithTheRightState) {
    const auto result = resultOf("/?code=a%2Fb-c&state=the+state&session_state=x");
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->code, "a/b-c");
    EXPECT_TRUE(result->error.empty());
    const auto denied = resultOf("/?error=access_denied&state=the%20state");
    ASSERT_TRUE(denied.has_value());
    EXPECT_EQ(denied->error, "access_denied");
}

TEST(Redirect, AnythingElseIsNotTheRedirect) {
    for (const char *const target :
         {"/", "/favicon.ico", "/?", "/?code=a", "/?code=a&state=", "/?code=a&state=another",
          "/?state=the+state", "/?code=&state=the+state", "/?code=a%0d%0ab&state=the+state",
          "/?code=a&code=b&state=the+state", "/?code=a&state=the+state&state=the+state",
          "/?code=%&state=the+state", "/?code=%4&state=the+state", "/?code=%zz&state=the+state",
          "/x?code=a&state=the+state", "http://127.0.0.1/?code=a&state=the+state"})
        EXPECT_FALSE(resultOf(target).has_value()) << target;
    EXPECT_FALSE(loginResultOf("POST /?code=a&state=s HTTP/1.1\r\n\r\n", "s").has_value());
    EXPECT_FALSE(loginResultOf("GET /?code=a&state=s", "s").has_value());
    EXPECT_FALSE(loginResultOf("GET /?code=a&state= HTTP/1.1\r\n\r\n", "").has_value());
    EXPECT_FALSE(loginResultOf("", "s").has_value());
    EXPECT_FALSE(resultOf("/?state=the+state&code=" + std::string(network::longestCode + 1, 'a')));
}

TEST(LoginJson, TokensAreRead) {
    const network::Tokens tokens = readTokens(
        R"({"access_token": "a", "token_type": "BEARER", "expires_in": 300, "refresh_token": "r"})");
    EXPECT_EQ(tokens, (network::Tokens{"a", "r", 300}));
    EXPECT_EQ(readTokens(R"({"access_token": "a", "token_type": "Bearer", "expires_in": "60"})"),
              (network::Tokens{"a", "", 60}));
    // A lifetime that makes no sense is unknown.
    for (const char *const lifetime : {"-1", "99999999999", "null", "[]", "\"soon\""})
        EXPECT_EQ(readTokens(std::string(R"({"access_token": "a", "token_type": "Bearer")") +
                             ", \"expires_in\": " + lifetime + "}")
                      .lifetimeSeconds,
                  0U)
            << lifetime;
}

TEST(LoginJson, OtherAnswersAreRefusedWithoutTheirText) {
    const std::string refusal = task::Reason(because::loginAnswerHasNoToken).english();
    for (const std::string &text :
         {std::string(), std::string("<html>"), std::string("[]"), std::string("\"secret\""),
          std::string(R"({"access_token": "secret"})"),
          std::string(R"({"access_token": "secret", "token_type": "mac"})"),
          std::string(R"({"access_token": 7, "token_type": "Bearer"})"),
          std::string(R"({"access_token": "", "token_type": "Bearer"})"),
          std::string(R"({"access_token": "secret\r\nX: y", "token_type": "Bearer"})"),
          std::string(
              R"({"access_token": "a", "token_type": "Bearer", "refresh_token": "secret b"})"),
          R"({"access_token": ")" + std::string(network::longestToken + 1, 's') +
              R"(", "token_type": "Bearer"})"})
        EXPECT_EQ(refusalOf(readTokens, text), refusal) << text;
    EXPECT_EQ(readError(R"({"error": "invalid_grant"})"), "invalid_grant");
    EXPECT_EQ(readError("secret"), "");
    EXPECT_TRUE(loginRefusal("access_denied").is(because::loginIsDenied));
    EXPECT_NE(loginRefusal("invalid_scope").english().find("invalid_scope"), std::string::npos);
    EXPECT_EQ(loginRefusal("secret").english().find("secret"), std::string::npos);
}

TEST(LoginJson, TheDescriptionOfALoginServerIsRead) {
    EXPECT_EQ(readEndpoints(R"({"issuer": "https://h", "authorization_endpoint": "https://h/a",
                                "token_endpoint": "https://h/t", "jwks_uri": "https://h/k"})"),
              (network::Endpoints{"https://h", "https://h/a", "https://h/t"}));
    const std::string refusal = task::Reason(because::issuerHasNoDescription).english();
    for (const char *const text :
         {"", "[]", R"({"issuer": "https://h", "token_endpoint": "https://h/t"})",
          R"({"issuer": "h", "authorization_endpoint": "a b", "token_endpoint": "t"})"})
        EXPECT_EQ(refusalOf(readEndpoints, text), refusal) << text;
}

} // namespace pellucid::network::process
