// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/network/process/login_json.h"
#include "core/network/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using Json = nlohmann::json;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

// Empty if there is no such text.
std::string textOf(const Json &json, const char *name) {
    const auto at = json.is_object() ? json.find(name) : json.end();
    return at != json.end() && at->is_string() ? at->get<std::string>() : std::string();
}

// Some servers write the number as a text. 0: unknown.
std::uint32_t lifetimeOf(const Json &json) {
    const auto at = json.find("expires_in");
    std::string text;
    if (at != json.end())
        text = at->is_string() ? at->get<std::string>() : at->is_number() ? at->dump() : "";
    std::uint32_t seconds = 0;
    std::from_chars(text.data(), text.data() + text.size(), seconds);
    return seconds;
}

} // namespace

Endpoints readEndpoints(const std::string &text) {
    const Json json = Json::parse(text, nullptr, false);
    const Endpoints endpoints{textOf(json, "issuer"), textOf(json, "authorization_endpoint"),
                              textOf(json, "token_endpoint")};
    for (const std::string *const url :
         {&endpoints.issuer, &endpoints.authorizationUrl, &endpoints.tokenUrl})
        if (!isVisible(*url, longestUrl))
            fail(because::issuerHasNoDescription);
    return endpoints;
}

Tokens readTokens(const std::string &text) {
    const Json json = Json::parse(text, nullptr, false);
    Tokens tokens{textOf(json, "access_token"), textOf(json, "refresh_token"), 0};
    // RFC 6749, 7.1: a token of an unknown type is not used.
    std::string type = textOf(json, "token_type");
    std::transform(type.begin(), type.end(), type.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    const bool isBearer = type == "bearer";
    if (!isBearer || !isVisible(tokens.access, longestToken) ||
        (!tokens.refresh.empty() && !isVisible(tokens.refresh, longestToken)))
        fail(because::loginAnswerHasNoToken);
    tokens.lifetimeSeconds = lifetimeOf(json);
    return tokens;
}

std::string readError(const std::string &text) {
    return textOf(Json::parse(text, nullptr, false), "error");
}

task::Reason loginRefusal(const std::string &error) {
    if (error == "access_denied")
        return because::loginIsDenied;
    constexpr std::array known{"invalid_request",
                               "invalid_client",
                               "invalid_grant",
                               "unauthorized_client",
                               "unsupported_grant_type",
                               "invalid_scope",
                               "unsupported_response_type",
                               "server_error",
                               "temporarily_unavailable",
                               "login_required",
                               "consent_required",
                               "interaction_required",
                               "account_selection_required"};
    const bool isKnown =
        std::any_of(known.begin(), known.end(), [&](const char *one) { return error == one; });
    return because::loginIsRefused(isKnown ? error : std::string("unknown error"));
}

} // namespace pellucid::network::process
