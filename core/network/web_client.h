// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/exchange/message.h"
#include "core/network/association.h"
#include "core/network/control.h"

namespace pellucid::network {

/// A connection to a DICOMweb service (PS3.18): one connection that libcurl gets open, because this
/// process gives up opening any before the first byte from the server. All requests *throw* Lost if
/// the connection fails, also when the server closes it between requests; Error{unusable} if the
/// server refuses; Disconnected; CancelledByProgram.
class WebClient {
public:
    /// *Throws* Lost, Error{usage} with the file that cannot be read.
    WebClient(const exchange::Connection &connection, Control &control);
    ~WebClient();
    WebClient(const WebClient &) = delete;
    WebClient &operator=(const WebClient &) = delete;

    int confinement() const { return m_confinement; }

    void echo(Control &control);
    exchange::QueryEnd find(const exchange::Query &query, Control &control);
    exchange::RetrievalEnd get(const exchange::Retrieval &retrieval, Control &control);
    /// STOW-RS of an open file of this size.
    void store(int file, std::uint64_t bytes, Control &control);

private:
    class Curl;
    std::unique_ptr<Curl> m_curl;
    exchange::Peer m_peer;
    int m_confinement = 0;
};

} // namespace pellucid::network
