// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/client/link.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "core/confined/helper.h"
#include "core/confined/packing.h"
#include "core/confined/protection.h"
#include "core/network/client/reasons.h"
#include "core/platform/connection_owner.h"
#include "core/system/log.h"
#include "core/task/error.h"

namespace pellucid::network {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using Kind = Message::Kind;

constexpr std::chrono::milliseconds releasePatience(300);
constexpr double startSeconds = 30.0; // on a loaded machine
constexpr double slackSeconds = 10.0; // beyond the helper's own patience
constexpr double cancelSeconds = 4.0; // the helper gives the server two

constexpr std::uint64_t largestPort = 65535;
constexpr std::size_t maxMatchesBytes = std::size_t(1) << 30; // of a search: a thousand each
constexpr std::uint64_t maxBytes = std::uint64_t(1)
                                   << 36; // of an object; more is an attack on the disk

void note(int confinement) {
    confined::noteProtection("network helpers", confinement);
}

} // namespace

Link::Link(double patienceSeconds) : m_patienceSeconds(patienceSeconds) {}

Link::Link(const Connection &connection, const task::Progress &progress,
           const StepObserver &observe)
    : m_connection(connection), m_patienceSeconds(connection.peer.silenceSeconds + slackSeconds) {
    requireSecureLogin(connection.peer);
    connect(progress, observe);
}

void Link::connect(const task::Progress &progress, const StepObserver &observe) {
    start();
    send({Kind::connect, 0, 0, pack(*m_connection)});
    const Peer &peer = m_connection->peer;
    const double patience = m_patienceSeconds;
    m_patienceSeconds =
        std::max(startSeconds, peer.connectSeconds + peer.associationSeconds + slackSeconds);
    m_confinement = converse(progress, nullptr, {}, observe, Kind::ready).code;
    m_patienceSeconds = patience;
    note(m_confinement);
    m_answers = 0;
    m_isArriving = false;
    m_isUsable = true;
}

template <class F> void Link::request(const task::Progress &progress, F &&make) {
    for (;;) {
        try {
            make();
            ++m_answers;
            return;
        } catch (const Error &error) {
            // Without an answer, another connection would be closed, too.
            if (!m_connection || m_connection->peer.protocol != Protocol::web ||
                !error.reason().is(because::serverHungUp) || m_answers == 0)
                throw;
        }
        connect(progress, {});
    }
}

Link::~Link() {
    // An association is released; servers log one that is only closed as aborted.
    if (m_isUsable)
        m_process.endWithin(releasePatience);
}

void Link::start() {
    const std::filesystem::path program = confined::findProgram("pellucid-net", "PELLUCID_NET");
    try {
        m_process = platform::Helper(program);
    } catch (const std::system_error &error) {
        throw Error(ErrorCode::internal,
                    because::helperCannotStart(task::systemReason(error.code())), program);
    }
}

void Link::echo(const task::Progress &progress, const StepObserver &observe) {
    request(progress, [&] {
        send({Kind::echo, 0, 0, {}});
        converse(progress, nullptr, {}, observe, Kind::done);
    });
}

QueryEnd Link::find(const Query &query, const std::function<void(Attributes)> &match,
                    const task::Progress &progress) {
    m_isAtWork = true;
    // Also if the helper does not keep to the limit.
    const std::uint32_t limit = query.limit == 0 ? maxMatches : std::min(query.limit, maxMatches);
    const std::uint32_t uidTag = uidOf(query.level);
    std::uint32_t count = 0;
    std::size_t room = maxMatchesBytes, came = 0;
    std::set<std::string> known;
    const auto counted = [&](Attributes attributes) {
        ++came;
        ++m_answers;
        // After a connection was closed, servers without offsets begin again.
        if (const std::string uid = attributes[uidTag]; !uid.empty() && !known.insert(uid).second)
            return;
        std::size_t bytes = 0;
        for (const auto &[tag, value] : attributes)
            bytes += sizeof tag + value.size();
        if (count == limit || bytes > room) {
            m_isUsable = false;
            throw Error(ErrorCode::unusable, because::serverListsTooMuch(count));
        }
        ++count;
        room -= bytes;
        match(std::move(attributes));
    };
    QueryEnd end;
    std::optional<std::uint32_t> before;
    request(progress, [&] {
        if (before == count && came > 0) { // the same page again
            end.mayBeIncomplete = true;
            return;
        }
        before = count;
        came = 0;
        Query rest = query;
        rest.skip = count;
        send({Kind::find, 0, 0, pack(rest)});
        end = unpack<QueryEnd>(converse(progress, nullptr, counted, {}, Kind::done).body);
    });
    return end;
}

RetrievalEnd Link::retrieve(const Retrieval &retrieval, Receiver &receiver,
                            const task::Progress &progress) {
    Retrieval wanted = retrieval;
    std::vector<std::string> uids = std::exchange(wanted.instanceUids, {});
    RetrievalEnd end;
    m_isAtWork = true;
    m_kept.clear();
    request(progress, [&] {
        std::erase_if(uids, [&](const std::string &uid) { return m_kept.contains(uid); });
        for (std::size_t n = 0; n < uids.size(); n += uidsAtOnce) {
            const auto from = uids.begin() + std::ptrdiff_t(n);
            const auto count = std::min(uidsAtOnce, uids.size() - n);
            send({Kind::uids, 0, 0, pack(std::vector(from, from + std::ptrdiff_t(count)))});
        }
        send({Kind::retrieve, 0, 0, pack(wanted)});
        end = unpack<RetrievalEnd>(converse(progress, &receiver, {}, {}, Kind::done).body);
    });
    return end;
}

std::optional<task::Reason> Link::store(platform::HandleView file, std::uint64_t bytes,
                                        const task::Progress &progress) {
    m_isAtWork = true;
    std::string remark;
    request(progress, [&] {
        send({Kind::store, 0, bytes, {}}, file);
        remark = converse(progress, nullptr, {}, {}, Kind::done).body;
    });
    return remark.empty() ? std::nullopt : std::optional(unpackReason(remark));
}

Endpoints Link::discover(const task::Progress &progress) {
    send({Kind::discover, 0, 0, {}});
    return unpack<Endpoints>(converse(progress, nullptr, {}, {}, Kind::done).body);
}

Tokens Link::requestTokens(const TokenRequest &request, const task::Progress &progress) {
    send({Kind::tokens, 0, 0, pack(request)});
    return unpack<Tokens>(converse(progress, nullptr, {}, {}, Kind::done).body);
}

void Link::send(const Message &message, platform::HandleView handle) {
    if (network::send(m_process.channel(), message, handle))
        return;
    fail({Kind::failed, -1, 0, {}});
}

Message Link::converse(const task::Progress &progress, Receiver *receiver,
                       const std::function<void(Attributes)> &match, const StepObserver &observe,
                       Kind end) {
    for (;;) {
        std::optional<Packet> packet;
        try {
            if (!confined::waitForPacket(m_process.channel(), m_patienceSeconds, progress)) {
                m_isUsable = false;
                throw Error(ErrorCode::unreachable, because::helperDoesNotAnswer);
            }
            packet = receive(m_process.channel());
        } catch (const task::Cancelled &) {
            requestCancel();
            throw;
        }
        if (!packet)
            fail({Kind::failed, -1, 0, {}});
        const Message &message = packet->message;
        if (message.kind == end)
            return message;
        switch (message.kind) {
        case Kind::step:
            if (observe && message.code >= 0 && message.code <= std::int32_t(Step::refused)) {
                std::string found = message.body.substr(0, 200);
                confined::makeOneLine(found);
                observe(Step(message.code), found);
            }
            break;
        case Kind::match:
            if (match)
                match(unpack<Attributes>(message.body));
            break;
        case Kind::ready: // of a server, whose requests end with `done`
            m_confinement = message.code;
            note(m_confinement);
            break;
        case Kind::progress:
            if (receiver != nullptr && m_isArriving && message.number > 0 &&
                message.number <= maxBytes)
                receiver->receive(message.number);
            break;
        case Kind::arrival:
        case Kind::received:
            if (receiver == nullptr || m_isArriving != (message.kind == Kind::received) ||
                message.number > maxBytes)
                fail({Kind::done, 0, 0, {}});
            take(*packet, *receiver);
            break;
        case Kind::browser: {
            if (m_loginPort == 0 || message.number > largestPort)
                fail({Kind::done, 0, 0, {}});
            const bool isOurs =
                platform::isOfThisUser(message.body, int(message.number), m_loginPort);
            send({isOurs ? Kind::kept : Kind::refused, 0, 0, {}});
            break;
        }
        default:
            fail(message);
        }
    }
}

void Link::take(const Packet &packet, Receiver &receiver) {
    const Message &message = packet.message;
    if (message.kind == Kind::arrival) {
        m_arrival = unpack<Arrival>(message.body);
        const auto answer = receiver.open(m_arrival);
        const auto *const file = std::get_if<platform::HandleView>(&answer);
        m_isArriving = file != nullptr;
        if (file != nullptr)
            send({Kind::file, 0, 0, {}}, *file);
        else
            send({Kind::refused, std::get<std::uint16_t>(answer), 0, {}});
    } else {
        m_isArriving = false;
        const std::uint16_t status = receiver.keep(m_arrival, message.number);
        if (status == 0) {
            ++m_answers;
            m_kept.insert(m_arrival.sopInstanceUid);
        }
        send({status == 0 ? Kind::kept : Kind::refused, status, 0, {}});
    }
}

// Lets the server end the request, then closes the connection.
void Link::requestCancel() {
    m_isUsable = false;
    if (!m_isAtWork) { // the server has nothing to end
        m_process = platform::Helper();
        return;
    }
    network::send(m_process.channel(), {Kind::cancel, 0, 0, {}});
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(cancelSeconds);
    while (std::chrono::steady_clock::now() < end) {
        if (!confined::waitForPacket(m_process.channel(), 0.1, {}))
            continue;
        const auto packet = receive(m_process.channel());
        if (!packet || packet->message.kind == Kind::done || packet->message.kind == Kind::failed)
            break;
        if (packet->message.kind == Kind::arrival || packet->message.kind == Kind::received)
            network::send(m_process.channel(), {Kind::refused, status::outOfResources, 0, {}});
    }
    m_process = platform::Helper();
}

void Link::fail(const Message &message) {
    if (message.kind == Kind::failed && message.code >= 0) {
        const task::Reason reason = unpackReason(message.body);
        switch (Failure(message.code)) {
        case Failure::refused:
            throw Error(ErrorCode::unusable, reason);
        case Failure::invalid:
            throw Error(ErrorCode::usage, reason);
        default:
            m_isUsable = false;
            throw Error(ErrorCode::unreachable, reason);
        }
    }
    m_isUsable = false;
    const std::optional<platform::Ending> ended =
        message.kind == Kind::failed ? m_process.ending() : std::nullopt;
    if (!ended)
        throw Error(ErrorCode::unreachable, because::implausibleReply);
    system::log("a network helper has ended unexpectedly, code " + std::to_string(ended->number));
    throw Error(ErrorCode::unreachable, ended->how == platform::Ending::How::brokeConfinement
                                            ? task::Reason(because::helperBrokeItsConfinement)
                                            : because::helperCrashed);
}

void serveClient(platform::Handle socket, const Acceptance &acceptance, Receiver &receiver,
                 const task::Progress &progress, const StepObserver &observe) {
    Link link(acceptance.silenceSeconds + slackSeconds);
    link.start();
    link.send({Kind::accept, 0, 0, pack(acceptance)}, socket);
    socket = platform::Handle(); // so that the client notices when the helper ends
    link.converse(progress, &receiver, {}, observe, Kind::done);
}

void awaitRedirect(LoopbackPort port, const Redirection &redirection,
                   const std::function<void()> &ready,
                   const std::function<void(const std::string &code)> &redeem,
                   const task::Progress &progress) {
    Link link(redirection.seconds + slackSeconds);
    link.start();
    link.m_loginPort = port.port;
    link.send({Kind::redirect, 0, 0, pack(redirection)}, port.socket);
    port.socket = platform::Handle(); // so that the browser notices when the helper ends
    note(link.converse(progress, nullptr, {}, {}, Kind::ready).code);
    ready();
    const std::string code = unpackCode(link.converse(progress, nullptr, {}, {}, Kind::code).body);
    std::exception_ptr failure;
    try {
        redeem(code);
    } catch (...) {
        failure = std::current_exception();
    }
    try {
        link.m_patienceSeconds = slackSeconds;
        link.send({failure ? Kind::refused : Kind::kept, 0, 0, {}});
        link.converse({}, nullptr, {}, {}, Kind::done);
    } catch (const Error &) { // only the browser's page is missing
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace pellucid::network
