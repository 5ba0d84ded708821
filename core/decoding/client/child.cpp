// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/child.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <system_error>

#include "core/confined/helper.h"
#include "core/confined/protection.h"
#include "core/decoding/client/reasons.h"
#include "core/system/log.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::decoding {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t firstArenaBytes = 1 << 20;
constexpr std::uint64_t keptArenaBytes = 16 << 20; // of an idle decoder
constexpr std::uint64_t largestBodyBytes = 64 << 20;
constexpr int maxMemoryRequests = 8; // requests for memory within one call
constexpr double startSeconds = 30;  // on a loaded machine

[[noreturn]] void failStarting(const std::filesystem::path &program, const task::Reason &reason) {
    throw Error(ErrorCode::internal, because::decoderCannotStart(reason), program);
}

std::atomic<std::uint64_t> grantedBytes = 0; // of all arenas

#ifdef PELLUCID_SANITIZED
constexpr double sanitizerFactor = 10.0;
#else
constexpr double sanitizerFactor = 1.0;
#endif

// The slowest codec decodes a few MB per second; a hospital's network share is slower.
double fullSeconds(const Message &request) {
    constexpr double bytesPerSecond = 1e6, baseSeconds = 20.0;
    return sanitizerFactor * (baseSeconds + double(request.size) / bytesPerSecond);
}

} // namespace

double decodingSeconds(const Message &request) {
    // A header skips the pixels, fragment by fragment.
    constexpr double headerShare = 0.1;
    const bool isHeader =
        request.kind == Message::Kind::header || request.kind == Message::Kind::layout;
    return (isHeader ? headerShare : 1.0) * fullSeconds(request);
}

double waitingSeconds(const Message &request) {
    constexpr double patience = 3.0;
    return fullSeconds(request) + patience;
}

Child::Child() = default;

// The delegated constructor has completed by then, so the destructor cleans up if this fails.
Child::Child(const std::filesystem::path &program, const task::Progress &progress) : Child() {
    start(program, progress);
}

Child::~Child() {
    grantedBytes -= m_grantedBytes;
}

void Child::start(const std::filesystem::path &program, const task::Progress &progress) {
    try {
        m_arena = platform::SharedMemory(firstArenaBytes);
        m_process = platform::Helper(program, m_arena.view());
    } catch (const std::system_error &error) {
        if (error.code() == std::errc::not_enough_memory)
            throw Error(ErrorCode::outOfMemory, because::noMemoryForADecoder);
        failStarting(program, task::systemReason(error.code()));
    }
    std::optional<Received> ready;
    allow(startSeconds);
    if (waitForMessage(progress))
        ready = receive(m_process.channel(), Takes::noHandles);
    if (!ready || ready->message.kind != Message::Kind::ready)
        failStarting(program, because::doesNotAnswer);
    m_confinement = ready->message.code;
    confined::noteProtection("decoders", m_confinement);
    m_isUsable = true;
}

void Child::ask(const Message &request, HandleView file) {
    allow(waitingSeconds(request));
    const bool isSent = send(m_process.channel(), request, file);
    m_isUsable = false; // until it has answered
    if (!isSent)
        throw Error(ErrorCode::unusable, because::decoderIsGone);
}

void Child::requestNext() {
    allow(waitingSeconds({Message::Kind::next, 0, 0, 0}));
    if (!send(m_process.channel(), {Message::Kind::next, 0, 0, 0}))
        failByExitStatus();
}

void Child::allow(double seconds) {
    m_end = Clock::now() +
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Child::waitForMessage(const task::Progress &progress) const {
    return confined::waitForPacket(
        m_process.channel(), std::chrono::duration<double>(m_end - Clock::now()).count(), progress);
}

Child::Answer Child::answer(const task::Progress &progress) {
    for (int memoryRequests = 0;;) {
        if (!waitForMessage(progress))
            throw Error(ErrorCode::unusable, because::takesTooLong);
        const auto received = receive(m_process.channel(), Takes::noHandles);
        if (!received)
            failByExitStatus();
        const Message &message = received->message;
        switch (message.kind) {
        case Message::Kind::need: {
            if (++memoryRequests > maxMemoryRequests) // a decoder that only asks for memory
                throw Error(ErrorCode::unusable, because::implausibleAnswer);
            const auto granted = grow(message.size);
            if (!send(m_process.channel(),
                      {granted ? Message::Kind::granted : Message::Kind::refused, 0,
                       m_arena.bytes(), 0},
                      granted.value_or(HandleView())))
                failByExitStatus();
            break;
        }
        case Message::Kind::part:
        case Message::Kind::done:
            return take(message);
        default:
            throw Error(ErrorCode::unusable, because::implausibleAnswer);
        }
    }
}

// Memory is granted on this side, because the decoder is not trusted.
std::optional<HandleView> Child::grow(std::uint64_t bytes) {
    if (bytes <= m_arena.bytes())
        return HandleView();
    const std::uint64_t more = bytes - m_arena.bytes(), available = system::availableMemoryBytes();
    // Other decoders may not have filled what they were granted. No sum may wrap: a decoder may ask
    // for any number.
    std::uint64_t granted = grantedBytes;
    do {
        if (granted > available || more > available - granted)
            return std::nullopt;
    } while (!grantedBytes.compare_exchange_weak(granted, granted + more));
    try {
        const bool isAnother = m_arena.grow(bytes);
        m_grantedBytes += more;
        if (!isAnother)
            return HandleView();
        m_mapped = files::Mapping();
        return m_arena.view();
    } catch (const std::system_error &) {
        grantedBytes -= more;
        return std::nullopt;
    }
}

Child::Answer Child::take(const Message &message) {
    if (message.size > std::min(m_arena.bytes(), largestBodyBytes) ||
        dataOffset(message.size) > m_arena.bytes() ||
        message.dataBytes > m_arena.bytes() - dataOffset(message.size))
        throw Error(ErrorCode::unusable, because::implausibleAnswer);
    if (m_mapped.size() < m_arena.bytes())
        m_mapped = files::Mapping(m_arena.view(), m_arena.bytes(), files::Mapping::Access::read);
    m_body.assign(reinterpret_cast<const char *>(m_mapped.data()), message.size);
    const auto body = std::as_bytes(std::span(m_body));
    if (message.kind == Message::Kind::done) {
        const auto refusal = message.code != 0 ? std::optional(unpackReason(body)) : std::nullopt;
        m_isUsable = true;
        if (refusal)
            throw Error(message.code == needsMemory ? ErrorCode::outOfMemory : ErrorCode::unusable,
                        *refusal);
    }
    return {message, body, m_mapped.bytes().subspan(dataOffset(message.size), message.dataBytes)};
}

void Child::failByExitStatus() {
    // If it still runs, it has sent an invalid message.
    const std::optional<platform::Ending> ended = m_process.ending();
    if (!ended)
        throw Error(ErrorCode::unusable, because::implausibleAnswer);
    system::log("a decoder has ended unexpectedly, code " + std::to_string(ended->number));
    using How = platform::Ending::How;
    switch (ended->how) {
    case How::tookTooLong:
        throw Error(ErrorCode::unusable, because::takesTooLong);
    case How::lostAFile:
        throw Error(ErrorCode::unusable, because::changedWhileRead);
    case How::wasKilled:
        throw Error(ErrorCode::outOfMemory, because::decoderWasKilled);
    case How::brokeConfinement:
        throw Error(ErrorCode::unusable, because::decoderBrokeItsConfinement);
    case How::byItself:
    case How::crashed:
        break;
    }
    throw Error(ErrorCode::unusable, because::decoderCrashed);
}

bool Child::isLarge() const {
    return m_arena.bytes() > keptArenaBytes;
}

} // namespace pellucid::decoding
