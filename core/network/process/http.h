// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/network/client/peer.h"
#include "core/network/process/association.h"
#include "core/network/process/control.h"

namespace pellucid::network::process {

/// HTTP over one connection, which libcurl gets open: this process gives up opening any before the
/// first byte from the server.
class HttpClient {
public:
    /// Connects and confines this process. *Throws* Lost, Error{usage} with the file that cannot be
    /// read.
    HttpClient(const Peer &peer, Control &control);
    ~HttpClient();
    HttpClient(const HttpClient &) = delete;
    HttpClient &operator=(const HttpClient &) = delete;

    int confinement() const { return m_confinement; }

    struct Request {
        std::string path;
        std::string accept;
        std::string contentType{};
        /// The body of a POST, piece by piece; none: a GET.
        std::vector<std::span<const std::byte>> body{};
        /// The most bytes of the answer's text.
        std::size_t longestText = 256 << 20;
    };
    struct Answer {
        long status = 0;
        std::string contentType, warning, location, retryAfter;
        std::string text; ///< unless it is taken as it comes
    };
    /// Receives the bytes of a successful answer as they come.
    using Take = std::function<void(const Answer &, std::span<const std::byte>)>;
    /// Follows redirections on the same server, and waits as long as a busy server asks for.
    /// *Throws* Lost if the connection fails, also when
    /// the server closes it between requests; Error{unusable} if the server points elsewhere or its
    /// answer is too long; what `take` throws; Disconnected; CancelledByProgram.
    Answer perform(const Request &request, const Take &take = {});

private:
    class Curl;
    int m_confinement = 0;
    std::unique_ptr<Curl> m_curl;
};

} // namespace pellucid::network::process
