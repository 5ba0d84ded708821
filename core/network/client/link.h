// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "core/network/client/login.h"
#include "core/network/client/message.h"
#include "core/platform/helper.h"
#include "core/task/progress.h"

namespace pellucid::network {

/// Takes the objects that arrive. Called from the thread of the request.
class Receiver {
public:
    virtual ~Receiver() = default;
    /// An open file for the object, or the status that refuses it (PS3.4, B.2.3).
    virtual std::variant<platform::HandleView, std::uint16_t> open(const Arrival &arrival) = 0;
    /// The object is complete; 0 bytes: it could not be written. *Returns* 0 when it is kept, or
    /// the status for the sender.
    virtual std::uint16_t keep(const Arrival &arrival, std::uint64_t bytes) = 0;
    /// Bytes of the current object so far, or 0 with objects that others received.
    virtual void receive(std::uint64_t) {}
};

using StepObserver = std::function<void(Step, const std::string &)>;

/// A connection to a server by a `pellucid-net` of its own, which can reach nothing but that server
/// and the files that it is given. Where a web server closes the connection between two answers, as
/// servers and proxies do after some of them, a new one goes on. Used by one thread at a time. All
/// requests *throw* Error{unreachable} if the connection fails; Error{unusable} if the server
/// refuses, after which it can be asked again; Error{usage}; Error{internal} if the helper cannot
/// be started; Cancelled, after which the connection is closed.
class Link {
public:
    /// Connects. calls `observe` after each successful step.
    Link(const Connection &connection, const task::Progress &progress = {},
         const StepObserver &observe = {});
    ~Link();
    Link(const Link &) = delete;
    Link &operator=(const Link &) = delete;

    /// Asks whether the server is there; what it offers is the last step that `observe` is told.
    void echo(const task::Progress &progress = {}, const StepObserver &observe = {});
    QueryEnd find(const Query &query, const std::function<void(Attributes)> &match,
                  const task::Progress &progress = {});
    RetrievalEnd retrieve(const Retrieval &retrieval, Receiver &receiver,
                          const task::Progress &progress = {});
    /// Sends an object from an open file of this size. *Returns* how the server changed the
    /// object; nothing if it stored it unchanged.
    std::optional<task::Reason> store(platform::HandleView file, std::uint64_t bytes,
                                      const task::Progress &progress = {});
    /// Reads the description of a login server at the path of the peer (OpenID Connect Discovery
    /// 1.0, 4). *Requires*: Purpose::login.
    Endpoints discover(const task::Progress &progress = {});
    /// Asks the token endpoint at the path of the peer (RFC 6749, 4.1.3 and 6). *Throws*
    /// Error{unusable, loginHasExpired} if a refresh token is refused. *Requires*: Purpose::login.
    Tokens requestTokens(const TokenRequest &request, const task::Progress &progress = {});

    bool isUsable() const { return m_isUsable; }
    /// See platform::Confinement.
    int confinement() const { return m_confinement; }

private:
    friend void serveClient(platform::Handle, const Acceptance &, Receiver &,
                            const task::Progress &, const StepObserver &);
    friend void awaitRedirect(LoopbackPort, const Redirection &, const std::function<void()> &,
                              const std::function<void(const std::string &)> &,
                              const task::Progress &);
    explicit Link(double patienceSeconds);
    void start();
    void connect(const task::Progress &progress, const StepObserver &observe);
    /// Makes a request, again while the server closes the connection after some answer.
    template <class F> void request(const task::Progress &progress, F &&make);
    void send(const Message &message, platform::HandleView handle = {});
    /// Passes on messages until the end of the request.
    Message converse(const task::Progress &progress, Receiver *receiver,
                     const std::function<void(Attributes)> &match, const StepObserver &observe,
                     Message::Kind end);
    void take(const Packet &packet, Receiver &receiver);
    [[noreturn]] void fail(const Message &message);
    void requestCancel();

    std::optional<Connection> m_connection;
    platform::Helper m_process;
    double m_patienceSeconds;
    int m_confinement = 0;
    bool m_isUsable = false;
    bool m_isAtWork = false;      ///< a server that is asked for more than an answer may be busy
    std::size_t m_answers = 0;    ///< on this connection: requests, matches and objects
    std::set<std::string> m_kept; ///< the objects of this request
    Arrival m_arrival;            ///< the current object
    bool m_isArriving = false;    ///< it has a file
    int m_loginPort = 0;          ///< where a browser ends a login
};

/// Serves a client that has connected, in a `pellucid-net` of its own, until the client ends the
/// association. *Throws* as the requests of a link.
void serveClient(platform::Handle socket, const Acceptance &acceptance, Receiver &receiver,
                 const task::Progress &progress = {}, const StepObserver &observe = {});

/// Awaits the redirect that ends a login on a listening socket, in a `pellucid-net` of its own that
/// reaches nothing else. `ready` is called when it listens, `redeem` with the authorization code;
/// the browser shows failure if `redeem` throws. *Throws* as the requests of a link;
/// Error{unusable} if the login is denied or nobody logs in; what `redeem` throws.
void awaitRedirect(LoopbackPort port, const Redirection &redirection,
                   const std::function<void()> &ready,
                   const std::function<void(const std::string &code)> &redeem,
                   const task::Progress &progress = {});

} // namespace pellucid::network
