// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/serve.h"

#include <memory>

#include "core/network/association.h"
#include "core/network/dimse.h"
#include "core/network/web_client.h"
#include "core/parse/serve.h"

namespace pellucid::network {

namespace {

namespace because = task::because;
using exchange::Failure;
using exchange::Purpose;
using Kind = Message::Kind;

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
            if (first.message.kind != Kind::connect)
                throw Disconnected();
            const auto connection = exchange::unpackConnection(first.message.body);
            if (connection.peer.protocol == exchange::Protocol::web) {
                WebClient client(connection, m_control);
                m_control.send({Kind::ready, client.confinement(), 0, {}});
                while (answerNext(client)) {
                }
                return;
            }
            Association association(connection, m_control);
            m_control.send({Kind::ready, association.confinement(), 0, {}});
            while (answerNext(association, connection.purpose)) {
            }
            association.release();
        });
    }

private:
    void accept(const exchange::Packet &packet) {
        Association association(exchange::unpackAcceptance(packet.message.body),
                                packet.descriptor.get(), m_control);
        m_control.send({Kind::ready, association.confinement(), 0, {}});
        provide(association, m_control);
        m_control.done();
    }

    // Returns false when the program is done with the connection.
    bool answerNext(Association &association, Purpose purpose) {
        auto packet = exchange::receive(m_control.socket());
        if (!packet)
            return false;
        const Message &message = packet->message;
        guardedRequest([&] {
            switch (message.kind) {
            case Kind::echo:
                echo(association, m_control);
                m_control.done();
                break;
            case Kind::find:
                m_control.done(exchange::pack(
                    find(association, exchange::unpackQuery(message.body), m_control)));
                break;
            case Kind::uids:
                takeUids(message);
                break;
            case Kind::retrieve: {
                const auto retrieval = retrievalOf(message);
                m_control.done(exchange::pack(purpose == Purpose::move
                                                  ? move(association, retrieval, m_control)
                                                  : get(association, retrieval, m_control)));
                break;
            }
            case Kind::store:
                store(association, packet->descriptor.get(), message.number, m_control);
                m_control.done();
                break;
            case Kind::cancel: // came after the request had ended
                break;
            default:
                throw Disconnected();
            }
        });
        return true;
    }

    bool answerNext(WebClient &client) {
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
                m_control.done(
                    exchange::pack(client.find(exchange::unpackQuery(message.body), m_control)));
                break;
            case Kind::uids:
                takeUids(message);
                break;
            case Kind::retrieve:
                m_control.done(exchange::pack(client.get(retrievalOf(message), m_control)));
                break;
            case Kind::store:
                client.store(packet->descriptor.get(), message.number, m_control);
                m_control.done();
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
        for (std::string &uid : exchange::unpackUids(message.body))
            m_uids.push_back(std::move(uid));
    }
    // With the instances that came before.
    exchange::Retrieval retrievalOf(const Message &message) {
        auto retrieval = exchange::unpackRetrieval(message.body);
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
                                                  : task::Reason(because::ofFile(
                                                        error.path().string(), error.reason())));
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
