// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/network/client/login.h"
#include "core/network/client/peer.h"
#include "core/network/process/control.h"
#include "core/network/process/http.h"

namespace pellucid::network::process {

/// A connection to a login server. All requests *throw* Lost if the connection fails or the server
/// is out of order; Error{unusable} if it refuses or its answer is unusable; Disconnected;
/// CancelledByProgram.
class LoginClient {
public:
    /// *Throws* Lost, Error{usage} with the file that cannot be read.
    LoginClient(const Peer &peer, Control &control);

    int confinement() const { return m_http.confinement(); }

    /// The description at the path of the peer (OpenID Connect Discovery 1.0, 4).
    Endpoints discover();
    /// Asks the token endpoint at the path of the peer (RFC 6749, 5).
    Tokens requestTokens(const TokenRequest &request);

private:
    std::string m_path;
    HttpClient m_http;
};

} // namespace pellucid::network::process
