// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/network/client/login.h"
#include "core/network/client/peer.h"
#include "core/network/client/query.h"
#include "core/platform/channel.h"
#include "core/task/reason.h"

namespace pellucid::network {

/// The messages between the program and `pellucid-net`: packets of at most `largestPacket` bytes,
/// some with an open file.
struct Message {
    enum class Kind : std::uint32_t {
        // sent to pellucid-net
        connect = 1, ///< body: Connection; the first message
        accept,      ///< body: Acceptance, with the connected socket; the first message of a server
        echo,
        find,     ///< body: Query
        retrieve, ///< body: Retrieval
        uids,     ///< body: more instances of the next `retrieve`
        store,    ///< with the open file; `number`: its size
        file,     ///< the answer to `arrival`: the open file to write to
        kept,     ///< the answer to `received`, `browser` and `code`
        refused,  ///< the other answer to these and to `arrival`; `code`: the status for the sender
        cancel,
        redirect, ///< body: Redirection, with the listening socket; the first message of a login
        discover, ///< of a login server: where its services are
        tokens,   ///< body: TokenRequest
        // sent by pellucid-net
        ready = 100, ///< it is confined, see platform::Confinement, and connected; `code`
        step,        ///< of connecting: `code` is a Step that succeeded, body: what it found
        match,       ///< body: Attributes
        arrival,     ///< body: Arrival; waits for `file`
        received,    ///< `number`: bytes of the file
        progress,    ///< work goes on; `number`: bytes received so far of the current object, or 0
        done,        ///< the end of a request. body: QueryEnd, RetrievalEnd, Endpoints, Tokens, of
                     ///< `store` a Reason if the server has changed the object, or none
        failed,      ///< body: Reason; `code`: a Failure
        browser,     ///< asks whether a connection to the login's port is of this user. body: its
                     ///< address; `number`: its port; waits for `kept` or `refused`
        code,        ///< body: the authorization code of a login; waits for `kept` or `refused`
    };
    Kind kind = Kind::ready;
    std::int32_t code = 0;
    std::uint64_t number = 0;
    std::string body;
};

/// The steps of connecting, in order; `refused`: kinds of objects that a client proposes and this
/// program does not take.
enum class Step : std::int32_t { name, tcp, tls, association, service, refused };

/// How a request failed.
enum class Failure : std::int32_t {
    lost,    ///< the connection: the server cannot be reached, or has gone
    refused, ///< by the server, which can be asked again
    invalid, ///< the request
};

inline constexpr std::size_t largestPacket = 96 << 10;
inline constexpr std::size_t uidsAtOnce = 1000;

struct Packet {
    Message message;
    platform::Handle handle;
};

/// Sends a message, and a handle if there is one; waits while the other end is busy. False if it is
/// closed.
bool send(const platform::Channel &channel, const Message &message,
          platform::HandleView handle = {});
/// Waits for a message. Empty if the other end is closed, or sent something else.
std::optional<Packet> receive(const platform::Channel &channel);

/// What a server of this program accepts from one connection.
struct Acceptance {
    std::string calledAe;                ///< the only name it answers to; empty: any
    std::vector<std::string> callingAes; ///< the senders it knows; empty: any
    /// With TLS, the names and addresses of which the client's certificate must have one; empty:
    /// any.
    std::vector<std::string> clientHosts;
    bool usesTls = false;
    std::string authorities, certificate, key, keyPassword; ///< as of Peer; authorities: required
    double silenceSeconds = 60.0;
};

/// Packing of bodies: of all types that `Message::Kind` names. Unpacking *throws* Error{unusable}
/// if the bytes are not such a value: a compromised process may send anything. Texts are made one
/// line; UIDs, URLs, tokens and codes are checked.
template <class T> std::string pack(const T &value);
template <class T> T unpack(const std::string &body);
task::Reason unpackReason(const std::string &body);
std::string unpackCode(const std::string &body);

} // namespace pellucid::network
