// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/platform/handle.h"
#include "core/task/reason.h"

class DcmTransportLayer;

namespace pellucid::network::process {

/// Certificates of a TLS connection; paths of files in PEM format.
struct Certificates {
    std::string authorities; ///< of a client: empty: those of the system
    std::string certificate, key, keyPassword;
    std::string
        host; ///< that the server's certificate must name; empty: this program is the server
    /// Of a server: names and addresses of which the client's certificate must have one; empty:
    /// any.
    std::vector<std::string> clientHosts{};
};

/// What happens while a connection is made, before and after the first byte from the network.
struct ConnectionEvents {
    std::function<void()> connected;
    std::function<void(const std::string &parameters)> secured;
};

/// How a DICOM connection is carried.
class Transport {
public:
    explicit Transport(ConnectionEvents events);
    /// With TLS by `applyTlsProfile`, the other side's certificate required and verified. *Throws*
    /// Error{usage} with the file that cannot be read.
    Transport(ConnectionEvents events, const Certificates &certificates);
    ~Transport();
    Transport(const Transport &) = delete;
    Transport &operator=(const Transport &) = delete;

    /// Is carried by a connection that is there, whatever DCMTK connects, which knows no IPv6.
    void use(platform::Handle connection) { m_state->connection = std::move(connection); }
    bool isSecure() const { return m_isSecure; }
    DcmTransportLayer &layer() { return *m_layer; }
    bool isConnected() const { return bool(m_state->socket); }
    platform::HandleView socket() const { return m_state->socket; }
    /// Why the handshake failed, if it did.
    const std::optional<task::Reason> &refusal() const { return m_state->refusal; }

    struct State {
        ConnectionEvents events;
        platform::HandleView socket;
        std::optional<task::Reason> refusal;

        platform::Handle connection; ///< until it is used
        platform::Handle replaced;   ///< DCMTK's socket, open because DCMTK sets its options

        /// Takes over the socket that DCMTK has made. *Returns* the one to use.
        platform::Native connected(platform::Native made);
    };

private:
    std::shared_ptr<State> m_state;
    bool m_isSecure = false;
    std::unique_ptr<DcmTransportLayer> m_layer;
};

} // namespace pellucid::network::process
