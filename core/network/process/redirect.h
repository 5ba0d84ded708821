// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/network/client/login.h"
#include "core/network/process/control.h"

namespace pellucid::network::process {

/// What the redirect at the end of a login says (RFC 6749, 4.1.2).
struct LoginResult {
    std::string code;
    std::string error; ///< empty: the login succeeded
};

/// Reads the head of an HTTP request. *Returns* nothing if it is not the redirect of the login with
/// this state.
std::optional<LoginResult> loginResultOf(const std::string &head, const std::string &state);

/// Confines this process to accepting connections on a listening socket, and awaits the redirect of
/// a browser there. Sends the program the authorization code, and shows in the browser whether the
/// program could use it. Other requests, and those of other users of this computer, are refused,
/// and the redirect is still awaited. *Throws* Error{unusable} if the login is denied or nobody
/// logs in; CancelledByProgram; Disconnected.
void awaitRedirect(platform::HandleView socket, const Redirection &redirection, Control &control);

} // namespace pellucid::network::process
