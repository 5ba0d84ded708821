// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/platform/handle.h"

namespace pellucid::network {

/// Where a login server has its services (RFC 6749, 3).
struct Endpoints {
    std::string issuer; ///< as the login server names itself; empty: unknown
    std::string authorizationUrl, tokenUrl;
    bool operator==(const Endpoints &) const = default;
};

/// The fields of a request for tokens (RFC 6749, 4.1.3 and 6).
using TokenRequest = std::map<std::string, std::string>;

struct Tokens {
    std::string access;
    std::string refresh;               ///< empty: none
    std::uint32_t lifetimeSeconds = 0; ///< of the access token; 0: unknown
    bool operator==(const Tokens &) const = default;
};

/// The redirect of a browser that ends a login (RFC 8252, 7.3).
struct Redirection {
    std::string state; ///< that the redirect must contain
    /// The sentences that the browser shows.
    std::string successText, failureText;
    double seconds = 300.0; ///< how long it is awaited
};

/// A port of 127.0.0.1, which other computers cannot reach.
struct LoopbackPort {
    platform::Handle socket; ///< listens
    int port = 0;
};

/// Opens a port that the system chooses. *Throws* Error{unreachable}.
LoopbackPort openLoopbackPort();

/// Whether a text has 1 to `longest` characters, all of them visible ASCII.
bool isVisible(const std::string &text, std::size_t longest);

/// Fields as the query of a URL or the body of a form (application/x-www-form-urlencoded).
std::string formEncoded(const std::map<std::string, std::string> &fields);

inline constexpr std::size_t longestUrl = 2000, longestCode = 8000, longestToken = 16000;

} // namespace pellucid::network
