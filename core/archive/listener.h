// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/server.h"
#include "core/network/client/link.h"

namespace pellucid::archive {

/// A sender that may connect.
struct Sender {
    std::string ae; ///< empty: any at this host
    std::string host;

    bool operator==(const Sender &) const = default;
};

struct ListenerOptions {
    std::string address;            ///< of this computer, IPv4 or IPv6; empty: all
    int port = defaultListenerPort; ///< 0: any free one
    std::string ae = "PELLUCID";
    std::vector<Sender> senders; ///< empty: nobody
    bool acceptsAnyone = false;
    /// With TLS, a sender's certificate must be from these authorities, and name the sender's host
    /// or address unless anyone is accepted.
    bool usesTls = false;
    std::string authorities, certificate, key, keyPassword; ///< as of network::Peer, none optional
    double negotiationSeconds = 10.0; ///< from the connection to the association
    /// In an association, until the next message is complete; a long one must make progress.
    double silenceSeconds = 60.0;

    bool operator==(const ListenerOptions &) const = default;
};

/// *Throws* Error{usage} with what is wrong or missing.
void requireValid(const ListenerOptions &options);

/// How a connection ended.
struct ConnectionEnd {
    std::string sender;                 ///< its AE title, or its address if the title is unknown
    std::string address;                ///< of its host
    std::size_t stored = 0;             ///< objects that were kept
    std::optional<task::Reason> reason; ///< empty: in order
    /// Kinds of objects that the sender proposed and this program does not take.
    std::optional<task::Reason> refused{};
};

/// Reports what a listener does, from the listener's threads, one call at a time.
struct ListenerObserver {
    std::function<void(const ConnectionEnd &)> ended;
};

/// A DICOM server for storage: accepts connections of known senders only, each in a `pellucid-net`
/// of its own. One address has at most a quarter of the connections that are served at once, and
/// one that does not negotiate gives way to the next. It runs as long as the object exists.
class Listener {
public:
    using Receivers = std::function<std::unique_ptr<network::Receiver>()>;
    /// `receivers` makes the receiver of each connection. *Throws* as requireValid;
    /// Error{unreachable} if another listener has the port; Error{usage} if it cannot be used
    /// otherwise.
    Listener(ListenerOptions options, Receivers receivers, ListenerObserver observer = {});
    ~Listener();
    Listener(const Listener &) = delete;
    Listener &operator=(const Listener &) = delete;

    int port() const;

private:
    class Threads;
    std::unique_ptr<Threads> m_threads;
};

} // namespace pellucid::archive
