// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/serve.h"

#include <memory>

#include "core/dicom_text/dictionary.h"
#include "core/network/client/reasons.h"
#include "core/network/process/association.h"
#include "core/network/process/dimse.h"
#include "core/network/process/login_client.h"
#include "core/network/process/redirect.h"
#include "core/network/process/web_client.h"
#include "core/platform/characters.h"
#include "core/task/reasons.h"

namespace pellucid::network::process {

namespace {

namespace because = task::because;
using Kind = Message::Kind;

// The requests of a DICOM server, as WebClient has those of a DICOMweb service.
struct DimseClient {
    Association association;
    Purpose purpose;

    void echo(Control &control) { network::process::echo(association, control); }
    QueryEnd find(const Query &query, Control &control) {
        return network::process::find(association, query, control);
    }
    RetrievalEnd retrieve(const Retrieval &retrieval, Control &control) {
        return purpose == Purpose::move ? move(association, retrieval, control)
                                        : get(association, retrieval, control);
    }
    std::optional<task::Reason> store(platform::HandleView file, std::uint64_t bytes,
                                      Control &control) {
        return network::process::store(association, file, bytes, control);
    }
};

class Session {
public:
    explicit Session(const platform::Channel &channel) : m_control(channel) {}

    void run() {
        Packet first = m_control.wait();
        guarded([&] {
            if (first.message.kind == Kind::accept) {
                accept(first);
                return;
            }
            if (first.message.kind == Kind::redirect) {
                guardedRequest([&] {
                    awaitRedirect(first.handle, unpack<Redirection>(first.message.body), m_control);
                });
                return;
            }
            if (first.message.kind != Kind::connect)
                throw Disconnected();
            const auto connection = unpack<Connection>(first.message.body);
            if (connection.purpose == Purpose::login) {
                LoginClient client(connection.peer, m_control);
                m_control.send({Kind::ready, client.confinement(), 0, {}});
                while (answerNext(client)) {
                }
                return;
            }
            if (connection.peer.protocol == Protocol::web) {
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
    void accept(const Packet &packet) {
        Association association(unpack<Acceptance>(packet.message.body), packet.handle, m_control);
        m_control.send({Kind::ready, association.confinement(), 0, {}});
        provide(association, m_control);
        m_control.done();
    }

    // Returns false when the program is done with the connection.
    template <class Client> bool answerNext(Client &client) {
        auto packet = receive(m_control.channel());
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
                m_control.done(pack(client.find(unpack<Query>(message.body), m_control)));
                break;
            case Kind::uids:
                takeUids(message);
                break;
            case Kind::retrieve:
                m_control.done(pack(client.retrieve(retrievalOf(message), m_control)));
                break;
            case Kind::store: {
                const auto change = client.store(packet->handle, message.number, m_control);
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
        const auto packet = receive(m_control.channel());
        if (!packet)
            return false;
        const Message &message = packet->message;
        guardedRequest([&] {
            switch (message.kind) {
            case Kind::discover:
                m_control.done(pack(client.discover()));
                break;
            case Kind::tokens:
                m_control.done(pack(client.requestTokens(unpack<TokenRequest>(message.body))));
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
        for (std::string &uid : unpack<std::vector<std::string>>(message.body))
            m_uids.push_back(std::move(uid));
    }
    // With the instances that came before.
    Retrieval retrievalOf(const Message &message) {
        auto retrieval = unpack<Retrieval>(message.body);
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
    dicom_text::prepareDictionary();
    platform::openCharacterTables();
}

int serve(const platform::Channel &channel) {
    try {
        Session(channel).run();
        return 0;
    } catch (const Disconnected &) {
        return 1;
    }
}

} // namespace pellucid::network::process
