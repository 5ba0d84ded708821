// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/login.h"

#include <algorithm>
#include <utility>

#include "core/archive/pkce.h"
#include "core/archive/reasons.h"
#include "core/network/client/link.h"
#include "core/network/client/reasons.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;
using network::Endpoints;
using network::Tokens;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::size_t stateBytes = 32, verifierBytes = 48; // 43 and 64 characters

// Before a token expires: a new connection must not meet the end of it at once.
std::chrono::milliseconds marginOf(std::chrono::milliseconds lifetime) {
    return std::min<std::chrono::milliseconds>(std::chrono::seconds(60), lifetime / 5);
}

// Names the login server when it cannot be reached: the user sees only that of the images.
template <class F> auto atLoginServer(const std::string &url, F &&work) {
    try {
        return work();
    } catch (const Error &error) {
        if (error.code() != ErrorCode::unreachable)
            throw;
        throw Error(error.code(), because::loginServerFails(loginPeer(url).host, error.reason()));
    }
}

std::string withoutSlash(std::string url) {
    if (url.ends_with('/'))
        url.pop_back();
    return url;
}

} // namespace

Login::Login(const Server &server, std::string refreshToken, Keep keep)
    : m_settings(server.loginSettings), m_peer(server.peer), m_keep(std::move(keep)),
      m_refresh(std::move(refreshToken)) {}

bool Login::isLoggedIn() const {
    const std::lock_guard lock(m_mutex);
    return !m_access.empty() || !m_refresh.empty();
}

bool Login::hasToken() const {
    return currentToken({}).has_value();
}

std::string Login::token(const task::Progress &progress, const std::string &refused) {
    if (auto current = currentToken(refused))
        return *std::move(current);
    const auto mine = turn(progress);
    if (auto current = currentToken(refused)) // another connection has renewed it
        return *std::move(current);
    const std::string refresh = refreshToken();
    // Another login would give a token that is refused for the same reason.
    if (refresh.empty() && !refused.empty() && isValid(refused))
        throw Error(ErrorCode::unusable, because::serverDoesNotAcceptTheLogin);
    try {
        if (refresh.empty())
            throw Error(ErrorCode::unusable, because::loginHasExpired);
        const Tokens tokens = requestTokens(endpoints(progress).tokenUrl,
                                            {{"grant_type", "refresh_token"},
                                             {"refresh_token", refresh},
                                             {"client_id", m_settings.clientId}},
                                            progress);
        if (!takeRenewed(tokens, refresh))
            throw Error(ErrorCode::unusable, because::loginHasExpired);
        return tokens.access;
    } catch (const Error &error) {
        // The user may have logged in again meanwhile.
        if (error.reason().is(because::loginHasExpired) && refreshToken() == refresh)
            forget();
        throw;
    }
}

void Login::logIn(const OpenPage &open, const Texts &texts, const task::Progress &progress,
                  double patience) {
    const Endpoints at = [&] {
        const auto mine = turn(progress);
        return endpoints(progress);
    }();
    network::LoopbackPort port = network::openLoopbackPort();
    const std::string state = randomText(stateBytes), verifier = randomText(verifierBytes),
                      redirectUrl = "http://127.0.0.1:" + std::to_string(port.port) + "/";
    std::map<std::string, std::string> query{{"response_type", "code"},
                                             {"client_id", m_settings.clientId},
                                             {"redirect_uri", redirectUrl},
                                             {"state", state},
                                             {"code_challenge", codeChallenge(verifier)},
                                             {"code_challenge_method", "S256"}};
    if (!m_settings.scope.empty())
        query["scope"] = m_settings.scope;
    // Without it, the server ignores that scope (OpenID Connect Core 1.0, 11).
    if (m_settings.scope.find("offline_access") != std::string::npos)
        query["prompt"] = "consent";
    const bool hasQuery = at.authorizationUrl.find('?') != std::string::npos;
    const std::string url =
        at.authorizationUrl + (hasQuery ? "&" : "?") + network::formEncoded(query);
    network::awaitRedirect(
        std::move(port), {state, texts.success, texts.failure, patience}, [&] { open(url); },
        [&](const std::string &code) {
            const Tokens tokens = requestTokens(at.tokenUrl,
                                                {{"grant_type", "authorization_code"},
                                                 {"code", code},
                                                 {"redirect_uri", redirectUrl},
                                                 {"client_id", m_settings.clientId},
                                                 {"code_verifier", verifier}},
                                                progress);
            forget(); // the tokens may be of another user
            take(tokens);
        },
        progress);
}

void Login::forget() {
    const std::lock_guard lock(m_mutex);
    m_access.clear();
    if (std::exchange(m_refresh, {}).empty())
        return;
    if (m_keep)
        m_keep({});
}

network::Connection Login::connectionTo(const std::string &url) const {
    network::Peer peer = loginPeer(url);
    peer.authorities = m_peer.authorities;
    peer.connectSeconds = m_peer.connectSeconds;
    peer.associationSeconds = m_peer.associationSeconds;
    peer.silenceSeconds = m_peer.silenceSeconds;
    return {.peer = std::move(peer), .purpose = network::Purpose::login};
}

Tokens Login::requestTokens(const std::string &url, const network::TokenRequest &request,
                            const task::Progress &progress) const {
    return atLoginServer(url, [&] {
        return network::Link(connectionTo(url), progress).requestTokens(request, progress);
    });
}

// Requires the turn.
Endpoints Login::endpoints(const task::Progress &progress) {
    if (m_endpoints)
        return *m_endpoints;
    Endpoints found{{}, m_settings.authorizationUrl, m_settings.tokenUrl};
    if (!m_settings.issuer.empty()) {
        const std::string issuer = withoutSlash(m_settings.issuer);
        const std::string url = issuer + "/.well-known/openid-configuration";
        found = atLoginServer(
            url, [&] { return network::Link(connectionTo(url), progress).discover(progress); });
        // OpenID Connect Discovery 1.0, 4.3: one login server must not speak for another.
        if (withoutSlash(found.issuer) != issuer)
            throw Error(ErrorCode::unusable, because::issuerIsAnother(found.issuer));
        for (const std::string *const address : {&found.authorizationUrl, &found.tokenUrl})
            loginPeer(*address);
    }
    m_endpoints = found;
    return found;
}

std::optional<std::string> Login::currentToken(const std::string &refused) const {
    const std::lock_guard lock(m_mutex);
    // Without a refresh token, it is used to its end.
    const bool isDue = !m_refresh.empty() && Clock::now() >= m_renewal;
    if (m_access.empty() || m_access == refused || isDue)
        return std::nullopt;
    return m_access;
}

std::string Login::refreshToken() const {
    const std::lock_guard lock(m_mutex);
    return m_refresh;
}

void Login::take(const Tokens &tokens) {
    const std::lock_guard lock(m_mutex);
    keepTokens(tokens);
}

bool Login::takeRenewed(const Tokens &tokens, const std::string &refresh) {
    const std::lock_guard lock(m_mutex);
    if (m_refresh != refresh)
        return false;
    keepTokens(tokens);
    return true;
}

bool Login::isValid(const std::string &token) const {
    const std::lock_guard lock(m_mutex);
    return token == m_access && Clock::now() < m_renewal;
}

// Requires the lock.
void Login::keepTokens(const Tokens &tokens) {
    m_access = tokens.access;
    const std::chrono::milliseconds lifetime = std::chrono::seconds(tokens.lifetimeSeconds);
    m_renewal = tokens.lifetimeSeconds == 0 ? Clock::time_point::max()
                                            : Clock::now() + lifetime - marginOf(lifetime);
    // A login server that sends no new refresh token lets the old one go on (RFC 6749, 6).
    if (tokens.refresh.empty() || tokens.refresh == m_refresh)
        return;
    m_refresh = tokens.refresh;
    if (m_keep)
        m_keep(m_refresh);
}

std::unique_lock<std::timed_mutex> Login::turn(const task::Progress &progress) {
    std::unique_lock lock(m_turn, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(50)))
        progress.check();
    return lock;
}

network::Peer authenticated(const Server &server, const task::Progress &progress,
                            const std::string &refusedToken) {
    network::Peer peer = server.peer;
    if (peer.authentication != network::Authentication::oauth)
        return peer;
    if (!server.login)
        throw Error(ErrorCode::unusable, because::loginHasExpired);
    peer.secret = server.login->token(progress, refusedToken);
    peer.authentication = network::Authentication::bearer;
    peer.allowsInsecureLogin = false;
    return peer;
}

bool isTokenRefused(const Server &server, const Error &error) {
    return server.login && error.reason().is(because::serverDoesNotAcceptTheLogin);
}

} // namespace pellucid::archive
