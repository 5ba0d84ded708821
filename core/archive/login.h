// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "core/archive/server.h"
#include "core/network/client/login.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::archive {

/// The login to a server by OAuth 2.0 in the user's browser (RFC 6749, 7636, 8252), and the source
/// of tokens for all connections to it. Each step runs in a `pellucid-net` of its own. Thread-safe.
class Login {
public:
    /// Called with each new refresh token, which is to be kept, or an empty one: the old one is no
    /// longer valid. *Requires*: it does not call this object.
    using Keep = std::function<void(const std::string &refreshToken)>;
    /// `refreshToken`: of an earlier login; empty: none.
    explicit Login(const Server &server, std::string refreshToken = {}, Keep keep = {});

    /// Whether the user need not log in, unless the login server refuses the refresh token.
    bool isLoggedIn() const;
    /// Whether `token` returns at once.
    bool hasToken() const;

    /// An access token for a new connection: not `refused`, which the server no longer accepts, and
    /// renewed if it is about to expire. *Throws* Error{unusable, loginHasExpired} if the user has
    /// to log in; Error{unusable, serverDoesNotAcceptTheLogin} if a token was refused before its
    /// end, and cannot be renewed; as network::Link otherwise.
    std::string token(const task::Progress &progress = {}, const std::string &refused = {});

    /// Opens a URL in the user's browser.
    using OpenPage = std::function<void(const std::string &url)>;
    /// The sentences that the browser shows at the end.
    struct Texts {
        std::string success = "You are logged in, and can close this window.";
        std::string failure = "The login failed; you can close this window.";
    };
    static constexpr double patienceSeconds = 300.0;
    /// Lets the user log in, and waits until that is done. *Throws* Error{unusable} if the login is
    /// denied or takes longer than `patience`; as network::Link otherwise; what `open` throws.
    void logIn(const OpenPage &open, const Texts &texts, const task::Progress &progress = {},
               double patience = patienceSeconds);
    void logIn(const OpenPage &open, const task::Progress &progress = {}) {
        logIn(open, Texts(), progress);
    }
    /// Forgets all tokens: the user has to log in again.
    void forget();

private:
    network::Connection connectionTo(const std::string &url) const;
    network::Endpoints endpoints(const task::Progress &progress);
    network::Tokens requestTokens(const std::string &url, const network::TokenRequest &request,
                                  const task::Progress &progress) const;
    std::optional<std::string> currentToken(const std::string &refused) const;
    std::string refreshToken() const;
    /// Whether it is the current token, and its end has not come.
    bool isValid(const std::string &token) const;
    void take(const network::Tokens &tokens);
    /// The same, unless the user has logged in again or out since `refresh` was sent.
    bool takeRenewed(const network::Tokens &tokens, const std::string &refresh);
    void keepTokens(const network::Tokens &tokens);
    std::unique_lock<std::timed_mutex> turn(const task::Progress &progress);

    const LoginSettings m_settings;
    const network::Peer m_peer; ///< of the server: its authorities and its patience
    const Keep m_keep;
    std::timed_mutex m_turn; ///< of whoever talks to the login server
    mutable std::mutex m_mutex;
    std::optional<network::Endpoints> m_endpoints;
    std::string m_access, m_refresh;
    std::chrono::steady_clock::time_point m_renewal; ///< when the access token is renewed
};

/// The peer of a server for a new connection, with a token if its login gives one. *Throws* as
/// Login::token.
network::Peer authenticated(const Server &server, const task::Progress &progress,
                            const std::string &refusedToken = {});

/// Whether a connection failed because the server no longer accepts its token, which can be
/// renewed.
bool isTokenRefused(const Server &server, const task::Error &error);

/// Runs `work` with the peer to connect to; once more with a renewed token if the server no longer
/// accepts the first. *Throws* as Login::token and `work`.
template <class F> auto withLogin(const Server &server, const task::Progress &progress, F &&work) {
    const network::Peer peer = authenticated(server, progress);
    try {
        return work(peer);
    } catch (const task::Error &error) {
        if (!isTokenRefused(server, error))
            throw;
    }
    return work(authenticated(server, progress, peer.secret));
}

} // namespace pellucid::archive
