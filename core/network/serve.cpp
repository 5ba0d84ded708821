// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/serve.h"

#include <memory>

#include "core/exchange/reasons.h"
#include "core/network/association.h"
#include "core/network/dimse.h"
#include "core/network/login_client.h"
#include "core/network/redirect.h"
#include "core/network/web_client.h"
#include "core/parse/serve.h"
#include "core/task/reasons.h"

namespace pellucid::network {

namespace {

namespace because = task::because;
using exchange::Failure;
using exchange::Purpose;
using Kind = Message::Kind;

// The requests of a DICOM server, as WebClient has those of a DICOMweb service.
struct DimseClient {
    Association association;
    Purpose purpose;

    void echo(Control &control) { network::echo(association, control); }
    exchange::QueryEnd find(const exchange::Query &query, Control &control) {
        return network::find(association, query, control);
    }
    exchange::RetrievalEnd retrieve(const exchange::Retrieval &retrieval, Control &control) {
        return purpose == Purpose::move ? move(association, retrieval, control)
                                        : get(association, retrieval, control);
    }
    std::optional<task::Reason> store(int file, std::uint64_t bytes, Control &control) {
        return network::store(association, file, bytes, control);
    }
};

class Session {
public:
    explicit Session(int socket) : m_control(socket) {}

    void run() {
        exchange::Packet first = m_control.wait();
        guarded([&] {
            if (first.message.kind == Kind::accept) {
                accept(first);
                return;
            }
            if (first.message.kind == Kind::redirect) {
                guardedRequest([&] {
                    awaitRedirect(first.descriptor.get(),
                                  exchange::unpack<exchange::Redirection>(first.message.body),
                                  m_control);
                });
                return;
            }
            if (first.message.kind != Kind::connect)
                throw Disconnected();
            const auto connection = exchange::unpack<exchange::Connection>(first.message.body);
            if (connection.purpose == Purpose::login) {
                LoginClient client(connection.peer, m_control);
                m_control.send({Kind::ready, client.confinement(), 0, {}});
                while (answerNext(client)) {
                }
                return;
            }
            if (connection.peer.protocol == exchange::Protocol::web) {
                WebClient client(connection, m_control);
                m_control.send({Kind::ready, client.confinement(), 0, {}});
                while (answerNext(client)) {
                }
                return;
            }
            DimseClient client{Association(connection, m_control), connection.purpose};
            m_control.send({Kind::ready, client.association.confinement(), 0, {}});
            while (answerNext(client)) {
            }
            client.association.release();
        });
    }

private:
    void accept(const exchange::Packet &packet) {
        Association association(exchange::unpack<exchange::Acceptance>(packet.message.body),
                                packet.descriptor.get(), m_control);
        m_control.send({Kind::ready, association.confinement(), 0, {}});
        provide(association, m_control);
        m_control.done();
    }

    // Returns false when the program is done with the connection.
    template <class Client> bool answerNext(Client &client) {
        auto packet = exchange::receive(m_control.socket());
        if (!packet)
            return false;
        const Message &message = packet->message;
        guardedRequest([&] {
            switch (message.kind) {
            case Kind::echo:
                client.echo(m_control);
                m_control.done();
                break;
            case Kind::find:
                m_control.done(exchange::pack(
                    client.find(exchange::unpack<exchange::Query>(message.body), m_control)));
                break;
            case Kind::uids:
                takeUids(message);
                break;
            case Kind::retrieve:
                m_control.done(exchange::pack(client.retrieve(retrievalOf(message), m_control)));
                break;
            case Kind::store: {
                const auto change =
                    client.store(packet->descriptor.get(), message.number, m_control);
                m_control.done(change ? change->encoded() : std::string());
                break;
            }
            case Kind::cancel: // came after the request had ended
                break;
            default:
                throw Disconnected();
            }
        });
        return true;
    }

    bool answerNext(LoginClient &client) {
        const auto packet = exchange::receive(m_control.socket());
        if (!packet)
            return false;
        const Message &message = packet->message;
        guardedRequest([&] {
            switch (message.kind) {
            case Kind::discover:
                m_control.done(exchange::pack(client.discover()));
                break;
            case Kind::tokens:
                m_control.done(exchange::pack(
                    client.requestTokens(exchange::unpack<exchange::TokenRequest>(message.body))));
                break;
            case Kind::cancel: // came after the request had ended
                break;
            default:
                throw Disconnected();
            }
        });
        return true;
    }

    void takeUids(const Message &message) {
        for (std::string &uid : exchange::unpack<std::vector<std::string>>(message.body))
            m_uids.push_back(std::move(uid));
    }
    // With the instances that came before.
    exchange::Retrieval retrievalOf(const Message &message) {
        auto retrieval = exchange::unpack<exchange::Retrieval>(message.body);
        retrieval.instanceUids = std::move(m_uids);
        m_uids.clear();
        return retrieval;
    }

    // A refused request leaves the connection in order.
    template <class F> void guardedRequest(F &&work) {
        try {
            work();
        } catch (const task::Error &error) {
            m_control.failed(error.code() == task::ErrorCode::usage ? Failure::invalid
                                                                    : Failure::refused,
                             error.reason());
        } catch (const CancelledByProgram &) {
            m_control.failed(Failure::lost, because::wasCancelled);
            throw Disconnected();
        }
    }

    template <class F> void guarded(F &&work) {
        try {
            work();
        } catch (const Lost &lost) {
            m_control.failed(Failure::lost, lost.reason);
        } catch (const CancelledByProgram &) {
            m_control.failed(Failure::lost, because::wasCancelled);
        } catch (const task::Error &error) {
            const bool isRefused = error.reason().is(because::serverLacksTheService);
            m_control.failed(isRefused ? Failure::refused : Failure::invalid,
                             error.path().empty() ? error.reason()
                                                  : task::Reason(because::at(error.path().string(),
                                                                             error.reason())));
        }
    }

    Control m_control;
    std::vector<std::string> m_uids;
};

} // namespace

void prepareToServe() {
    parse::prepareToServe();
}

int serve(int socket) {
    try {
        Session(socket).run();
        return 0;
    } catch (const Disconnected &) {
        return 1;
    }
}

} // namespace pellucid::network
