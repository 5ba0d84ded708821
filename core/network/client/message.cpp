// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/message.h"

#include "core/confined/packing.h"
#include "core/network/client/reasons.h"

// In the archives' namespace, where the templates of packing.h find them.
namespace pellucid::confined {

using namespace network;

template <class A> void pass(A &archive, Peer &peer) {
    passAll(archive, peer.protocol, peer.host, peer.calledAe, peer.callingAe, peer.path,
            peer.authorities, peer.certificate, peer.key, peer.keyPassword, peer.user, peer.secret,
            peer.characterSet, peer.port, peer.usesTls, peer.authentication,
            peer.allowsInsecureLogin, peer.connectSeconds, peer.associationSeconds,
            peer.silenceSeconds);
}

template <class A> void pass(A &archive, Encoding &encoding) {
    passAll(archive, encoding.sopClassUid, encoding.transferSyntax);
}

template <class A> void pass(A &archive, Connection &connection) {
    passAll(archive, connection.peer, connection.purpose, connection.sopClasses,
            connection.transferSyntaxes, connection.encodings);
}

template <class A> void pass(A &archive, Acceptance &acceptance) {
    passAll(archive, acceptance.calledAe, acceptance.authorities, acceptance.certificate,
            acceptance.key, acceptance.keyPassword, acceptance.callingAes, acceptance.clientHosts,
            acceptance.usesTls, acceptance.silenceSeconds);
}

template <class A> void pass(A &archive, Query &query) {
    passAll(archive, query.level, query.keys, query.limit, query.skip);
}

template <class A> void pass(A &archive, QueryEnd &end) {
    passAll(archive, end.reachedLimit, end.mayBeIncomplete, end.warnings);
}

template <class A> void pass(A &archive, Retrieval &retrieval) {
    passAll(archive, retrieval.level, retrieval.studyUid, retrieval.seriesUid,
            retrieval.instanceUids, retrieval.destinationAe);
}

template <class A> void pass(A &archive, RetrievalEnd &end) {
    passAll(archive, end.completed, end.failed, end.warnings, end.failedInstances, end.reason);
}

template <class A> void pass(A &archive, Arrival &arrival) {
    passAll(archive, arrival.sopClassUid, arrival.sopInstanceUid, arrival.transferSyntax,
            arrival.callingAe);
}

template <class A> void pass(A &archive, Redirection &redirection) {
    passAll(archive, redirection.state, redirection.successText, redirection.failureText,
            redirection.seconds);
}

template <class A> void pass(A &archive, Endpoints &endpoints) {
    passAll(archive, endpoints.issuer, endpoints.authorizationUrl, endpoints.tokenUrl);
}

template <class A> void pass(A &archive, Tokens &tokens) {
    passAll(archive, tokens.access, tokens.refresh, tokens.lifetimeSeconds);
}

} // namespace pellucid::confined

namespace pellucid::network {

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

void requireUid(const std::string &text) {
    if (!isUid(text))
        fail();
}

void check(QueryEnd &end) {
    for (std::string &warning : end.warnings)
        confined::makeOneLine(warning);
}

void check(RetrievalEnd &end) {
    for (const std::string &uid : end.failedInstances)
        requireUid(uid);
    if (!end.reason.empty())
        end.reason = unpackReason(end.reason).encoded();
}

void check(Arrival &arrival) {
    requireUid(arrival.sopClassUid);
    requireUid(arrival.sopInstanceUid);
    requireUid(arrival.transferSyntax);
    confined::makeOneLine(arrival.callingAe);
}

void check(Attributes &attributes) {
    for (auto &[tag, value] : attributes)
        confined::makeOneLine(value);
}

void check(const std::vector<std::string> &uids) {
    for (const std::string &uid : uids)
        requireUid(uid);
}

void check(const Endpoints &endpoints) {
    for (const std::string *const url : {&endpoints.authorizationUrl, &endpoints.tokenUrl})
        if (!isVisible(*url, longestUrl))
            fail();
    if (!endpoints.issuer.empty() && !isVisible(endpoints.issuer, longestUrl))
        fail();
}

// A token becomes part of a header: no line break passes.
void check(const Tokens &tokens) {
    if (!isVisible(tokens.access, longestToken) ||
        (!tokens.refresh.empty() && !isVisible(tokens.refresh, longestToken)))
        fail();
}

// The other types contain no text that is shown or names a file.
template <class T> void check(const T & /*value*/) {}

} // namespace

bool send(const platform::Channel &channel, const Message &message, platform::HandleView handle) {
    if (message.body.size() > largestPacket)
        return false;
    const Header header{std::uint32_t(message.kind), message.code, message.number};
    return channel.send(std::as_bytes(std::span(&header, 1)),
                        std::as_bytes(std::span(message.body)), handle, platform::WhenBusy::wait);
}

std::optional<Packet> receive(const platform::Channel &channel) {
    Packet packet;
    Header header{};
    std::string &body = packet.message.body;
    body.resize(largestPacket);
    auto received =
        channel.receive(std::as_writable_bytes(std::span(&header, 1)),
                        std::as_writable_bytes(std::span(body)), platform::Takes::handle);
    if (!received)
        return std::nullopt;
    packet.message.kind = Message::Kind(header.kind);
    packet.message.code = header.code;
    packet.message.number = header.number;
    body.resize(received->bytes - sizeof header);
    packet.handle = std::move(received->handle);
    return packet;
}

template <class T> std::string pack(const T &value) {
    return confined::packed(value);
}

template <class T> T unpack(const std::string &body) {
    auto value = confined::unpacked<T>(std::as_bytes(std::span(body)), because::implausibleReply);
    check(value);
    return value;
}

template std::string pack(const Connection &);
template std::string pack(const Acceptance &);
template std::string pack(const Query &);
template std::string pack(const QueryEnd &);
template std::string pack(const Retrieval &);
template std::string pack(const RetrievalEnd &);
template std::string pack(const Arrival &);
template std::string pack(const Attributes &);
template std::string pack(const std::vector<std::string> &);
template std::string pack(const Redirection &);
template std::string pack(const Endpoints &);
template std::string pack(const TokenRequest &);
template std::string pack(const Tokens &);
template Connection unpack(const std::string &);
template Acceptance unpack(const std::string &);
template Query unpack(const std::string &);
template QueryEnd unpack(const std::string &);
template Retrieval unpack(const std::string &);
template RetrievalEnd unpack(const std::string &);
template Arrival unpack(const std::string &);
template Attributes unpack(const std::string &);
template std::vector<std::string> unpack(const std::string &);
template Redirection unpack(const std::string &);
template Endpoints unpack(const std::string &);
template TokenRequest unpack(const std::string &);
template Tokens unpack(const std::string &);

task::Reason unpackReason(const std::string &body) {
    return confined::unpackedReason(std::as_bytes(std::span(body)), because::implausibleReply);
}

std::string unpackCode(const std::string &body) {
    if (!isVisible(body, longestCode))
        fail();
    return body;
}

} // namespace pellucid::network
