// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/child.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

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

[[noreturn]] void failStarting(const std::filesystem::path &program, int error) {
    if (error == ENOMEM)
        throw Error(ErrorCode::outOfMemory, because::noMemoryForADecoder);
    throw Error(ErrorCode::internal,
                because::decoderCannotStart(error == 0 ? because::doesNotAnswer
                                                       : task::systemReason(error)),
                program);
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
    {
        // Above the standard streams, which may be closed: prints would go into it.
        constexpr int aboveStreams = 10;
        const platform::Handle lowest(
            ::memfd_create("pellucid-decode", MFD_CLOEXEC | MFD_ALLOW_SEALING));
        m_arena =
            platform::Handle(lowest ? ::fcntl(lowest.get(), F_DUPFD_CLOEXEC, aboveStreams) : -1);
    }
    // The arena must never shrink: reading beyond its end would kill the program.
    if (!m_arena || ::ftruncate(m_arena.get(), off_t(firstArenaBytes)) != 0 ||
        ::fcntl(m_arena.get(), F_ADD_SEALS, F_SEAL_SHRINK) != 0)
        failStarting(program, errno);
    m_arenaBytes = firstArenaBytes;
    try {
        m_process = confined::Process({.path = program, .file = m_arena.get(), .environment = {}});
    } catch (const std::system_error &error) {
        failStarting(program, error.code().value());
    }
    std::optional<Received> ready;
    allow(startSeconds);
    if (waitForMessage(progress))
        ready = receive(m_process.socket(), Takes::noDescriptors);
    if (!ready || ready->message.kind != Message::Kind::ready)
        failStarting(program, 0);
    m_confinement = ready->message.code;
    confined::noteProtection("decoders", m_confinement);
    m_isUsable = true;
}

void Child::ask(const Message &request, int file) {
    allow(waitingSeconds(request));
    const bool isSent = send(m_process.socket(), request, file);
    m_isUsable = false; // until it has answered
    if (!isSent)
        throw Error(ErrorCode::unusable, because::decoderIsGone);
}

void Child::requestNext() {
    allow(waitingSeconds({Message::Kind::next, 0, 0, 0}));
    if (!send(m_process.socket(), {Message::Kind::next, 0, 0, 0}))
        failByExitStatus();
}

void Child::allow(double seconds) {
    m_end = Clock::now() +
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Child::waitForMessage(const task::Progress &progress) const {
    return confined::waitForPacket(
        m_process.socket(), std::chrono::duration<double>(m_end - Clock::now()).count(), progress);
}

Child::Answer Child::answer(const task::Progress &progress) {
    for (int memoryRequests = 0;;) {
        if (!waitForMessage(progress))
            throw Error(ErrorCode::unusable, because::takesTooLong);
        const auto received = receive(m_process.socket(), Takes::noDescriptors);
        if (!received)
            failByExitStatus();
        const Message &message = received->message;
        switch (message.kind) {
        case Message::Kind::need: {
            if (++memoryRequests > maxMemoryRequests) // a decoder that only asks for memory
                throw Error(ErrorCode::unusable, because::implausibleAnswer);
            const bool isGranted = grow(message.size);
            if (!send(m_process.socket(),
                      {isGranted ? Message::Kind::granted : Message::Kind::refused, 0, m_arenaBytes,
                       0}))
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
bool Child::grow(std::uint64_t bytes) {
    if (bytes <= m_arenaBytes)
        return true;
    const std::uint64_t more = bytes - m_arenaBytes, available = system::availableMemoryBytes();
    // Other decoders may not have filled what they were granted. No sum may wrap: a decoder may ask
    // for any number.
    std::uint64_t granted = grantedBytes;
    do {
        if (granted > available || more > available - granted)
            return false;
    } while (!grantedBytes.compare_exchange_weak(granted, granted + more));
    if (::ftruncate(m_arena.get(), off_t(bytes)) != 0) {
        grantedBytes -= more;
        return false;
    }
    m_grantedBytes += more;
    m_arenaBytes = bytes;
    return true;
}

Child::Answer Child::take(const Message &message) {
    if (message.size > std::min(m_arenaBytes, largestBodyBytes) ||
        dataOffset(message.size) > m_arenaBytes ||
        message.dataBytes > m_arenaBytes - dataOffset(message.size))
        throw Error(ErrorCode::unusable, because::implausibleAnswer);
    if (m_mapped.size() < m_arenaBytes)
        m_mapped = files::Mapping(m_arena.get(), m_arenaBytes, files::Mapping::Access::read);
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
    const std::optional<int> ended = m_process.endSignal();
    if (!ended)
        throw Error(ErrorCode::unusable, because::implausibleAnswer);
    const int signal = *ended;
    system::log("a decoder was ended by signal " + std::to_string(signal));
    switch (signal) {
    case SIGPROF:
        throw Error(ErrorCode::unusable, because::takesTooLong);
    case SIGBUS:
        throw Error(ErrorCode::unusable, because::changedWhileRead);
    case SIGKILL:
        throw Error(ErrorCode::outOfMemory, because::decoderWasKilled);
    case SIGSYS:
        throw Error(ErrorCode::unusable, because::decoderBrokeItsConfinement);
    default:
        throw Error(ErrorCode::unusable, because::decoderCrashed);
    }
}

bool Child::isLarge() const {
    return m_arenaBytes > keptArenaBytes;
}

} // namespace pellucid::decoding
