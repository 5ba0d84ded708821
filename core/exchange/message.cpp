// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/message.h"

#include "core/exchange/reasons.h"
#include "core/helper/packet.h"
#include "core/helper/packing.h"

// In the archives' namespace, where the templates of packing.h find them.
namespace pellucid::helper {

using namespace exchange;

template <class A> void pass(A &archive, Peer &peer) {
    pass(archive, peer.protocol);
    for (std::string *const text :
         {&peer.host, &peer.calledAe, &peer.callingAe, &peer.path, &peer.authorities,
          &peer.certificate, &peer.key, &peer.keyPassword, &peer.user, &peer.secret,
          &peer.characterSet})
        pass(archive, *text);
    pass(archive, peer.port);
    pass(archive, peer.usesTls);
    pass(archive, peer.authentication);
    pass(archive, peer.allowsInsecureLogin);
    for (double *const seconds :
         {&peer.connectSeconds, &peer.associationSeconds, &peer.silenceSeconds})
        pass(archive, *seconds);
}

template <class A> void pass(A &archive, Encoding &encoding) {
    pass(archive, encoding.sopClassUid);
    pass(archive, encoding.transferSyntax);
}

template <class A> void pass(A &archive, Connection &connection) {
    pass(archive, connection.peer);
    pass(archive, connection.purpose);
    pass(archive, connection.sopClasses);
    pass(archive, connection.transferSyntaxes);
    pass(archive, connection.encodings);
}

template <class A> void pass(A &archive, Acceptance &acceptance) {
    for (std::string *const text :
         {&acceptance.calledAe, &acceptance.authorities, &acceptance.certificate, &acceptance.key,
          &acceptance.keyPassword})
        pass(archive, *text);
    pass(archive, acceptance.callingAes);
    pass(archive, acceptance.clientHosts);
    pass(archive, acceptance.usesTls);
    pass(archive, acceptance.silenceSeconds);
}

template <class A> void pass(A &archive, Query &query) {
    pass(archive, query.level);
    pass(archive, query.keys);
    pass(archive, query.limit);
    pass(archive, query.skip);
}

template <class A> void pass(A &archive, QueryEnd &end) {
    pass(archive, end.reachedLimit);
    pass(archive, end.mayBeIncomplete);
    pass(archive, end.warnings);
}

template <class A> void pass(A &archive, Retrieval &retrieval) {
    pass(archive, retrieval.level);
    pass(archive, retrieval.studyUid);
    pass(archive, retrieval.seriesUid);
    pass(archive, retrieval.instanceUids);
    pass(archive, retrieval.destinationAe);
}

template <class A> void pass(A &archive, RetrievalEnd &end) {
    for (std::uint32_t *const number : {&end.completed, &end.failed, &end.warnings})
        pass(archive, *number);
    pass(archive, end.failedInstances);
    pass(archive, end.reason);
}

template <class A> void pass(A &archive, Arrival &arrival) {
    for (std::string *const text : {&arrival.sopClassUid, &arrival.sopInstanceUid,
                                    &arrival.transferSyntax, &arrival.callingAe})
        pass(archive, *text);
}

template <class A> void pass(A &archive, Redirection &redirection) {
    for (std::string *const text :
         {&redirection.state, &redirection.successText, &redirection.failureText})
        pass(archive, *text);
    pass(archive, redirection.seconds);
}

template <class A> void pass(A &archive, Endpoints &endpoints) {
    for (std::string *const text :
         {&endpoints.issuer, &endpoints.authorizationUrl, &endpoints.tokenUrl})
        pass(archive, *text);
}

template <class A> void pass(A &archive, Tokens &tokens) {
    pass(archive, tokens.access);
    pass(archive, tokens.refresh);
    pass(archive, tokens.lifetimeSeconds);
}

} // namespace pellucid::helper

namespace pellucid::exchange {

namespace {

namespace because = task::because;

struct Header {
    std::uint32_t kind;
    std::int32_t code;
    std::uint64_t number;
};

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, because::implausibleReply);
}

template <class T> T unpacked(const std::string &body) {
    return helper::unpacked<T>(std::as_bytes(std::span(body)), because::implausibleReply);
}

void requireUid(const std::string &text) {
    if (!isUid(text))
        fail();
}

} // namespace

bool send(int socket, const Message &message, int descriptor) {
    if (message.body.size() > largestPacket)
        return false;
    const Header header{std::uint32_t(message.kind), message.code, message.number};
    return helper::sendPacket(socket, std::as_bytes(std::span(&header, 1)),
                              std::as_bytes(std::span(message.body)), descriptor,
                              helper::WhenBusy::wait);
}

std::optional<Packet> receive(int socket) {
    Packet packet;
    Header header{};
    std::string &body = packet.message.body;
    body.resize(largestPacket);
    auto received =
        helper::receivePacket(socket, std::as_writable_bytes(std::span(&header, 1)),
                              std::as_writable_bytes(std::span(body)), helper::Takes::descriptor);
    if (!received)
        return std::nullopt;
    packet.message.kind = Message::Kind(header.kind);
    packet.message.code = header.code;
    packet.message.number = header.number;
    body.resize(received->bytes - sizeof header);
    packet.descriptor = std::move(received->descriptor);
    return packet;
}

std::string pack(const Connection &connection) {
    return helper::packed(connection);
}

std::string pack(const Acceptance &acceptance) {
    return helper::packed(acceptance);
}

std::string pack(const Query &query) {
    return helper::packed(query);
}

std::string pack(const QueryEnd &end) {
    return helper::packed(end);
}

std::string pack(const Retrieval &retrieval) {
    return helper::packed(retrieval);
}

std::string pack(const RetrievalEnd &end) {
    return helper::packed(end);
}

std::string pack(const Arrival &arrival) {
    return helper::packed(arrival);
}

std::string pack(const Attributes &attributes) {
    return helper::packed(attributes);
}

std::string pack(const std::vector<std::string> &uids) {
    return helper::packed(uids);
}

std::string pack(const Redirection &redirection) {
    return helper::packed(redirection);
}

std::string pack(const Endpoints &endpoints) {
    return helper::packed(endpoints);
}

std::string pack(const TokenRequest &request) {
    return helper::packed(request);
}

std::string pack(const Tokens &tokens) {
    return helper::packed(tokens);
}

Connection unpackConnection(const std::string &body) {
    return unpacked<Connection>(body);
}

Acceptance unpackAcceptance(const std::string &body) {
    return unpacked<Acceptance>(body);
}

Query unpackQuery(const std::string &body) {
    return unpacked<Query>(body);
}

Retrieval unpackRetrieval(const std::string &body) {
    return unpacked<Retrieval>(body);
}

QueryEnd unpackQueryEnd(const std::string &body) {
    auto end = unpacked<QueryEnd>(body);
    for (std::string &warning : end.warnings)
        helper::makeOneLine(warning);
    return end;
}

RetrievalEnd unpackRetrievalEnd(const std::string &body) {
    auto end = unpacked<RetrievalEnd>(body);
    for (const std::string &uid : end.failedInstances)
        requireUid(uid);
    if (!end.reason.empty())
        end.reason = unpackReason(end.reason).encoded();
    return end;
}

Arrival unpackArrival(const std::string &body) {
    auto arrival = unpacked<Arrival>(body);
    requireUid(arrival.sopClassUid);
    requireUid(arrival.sopInstanceUid);
    requireUid(arrival.transferSyntax);
    helper::makeOneLine(arrival.callingAe);
    return arrival;
}

Attributes unpackAttributes(const std::string &body) {
    auto attributes = unpacked<Attributes>(body);
    for (auto &[tag, value] : attributes)
        helper::makeOneLine(value);
    return attributes;
}

std::vector<std::string> unpackUids(const std::string &body) {
    auto uids = unpacked<std::vector<std::string>>(body);
    for (const std::string &uid : uids)
        requireUid(uid);
    return uids;
}

task::Reason unpackReason(const std::string &body) {
    return helper::unpackedReason(std::as_bytes(std::span(body)), because::implausibleReply);
}

Redirection unpackRedirection(const std::string &body) {
    return unpacked<Redirection>(body);
}

Endpoints unpackEndpoints(const std::string &body) {
    auto endpoints = unpacked<Endpoints>(body);
    for (const std::string *const url : {&endpoints.authorizationUrl, &endpoints.tokenUrl})
        if (!isVisible(*url, longestUrl))
            fail();
    if (!endpoints.issuer.empty() && !isVisible(endpoints.issuer, longestUrl))
        fail();
    return endpoints;
}

TokenRequest unpackTokenRequest(const std::string &body) {
    return unpacked<TokenRequest>(body);
}

// A token becomes part of a header: no line break passes.
Tokens unpackTokens(const std::string &body) {
    auto tokens = unpacked<Tokens>(body);
    if (!isVisible(tokens.access, longestToken) ||
        (!tokens.refresh.empty() && !isVisible(tokens.refresh, longestToken)))
        fail();
    return tokens;
}

std::string unpackCode(const std::string &body) {
    if (!isVisible(body, longestCode))
        fail();
    return body;
}

} // namespace pellucid::exchange
