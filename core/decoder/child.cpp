// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/child.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "core/system/log.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::decoder {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t firstArenaBytes = 1 << 20;
constexpr std::uint64_t keptArenaBytes = 16 << 20; // of an idle decoder
constexpr std::uint64_t largestBodyBytes = 64 << 20;
constexpr int cancelPollMs = 20;     // the longest wait after a cancel
constexpr int maxMemoryRequests = 8; // requests for memory within one call
constexpr double startSeconds = 30;  // on a loaded machine
constexpr std::chrono::milliseconds endPatience(500);

[[noreturn]] void failStarting(const std::filesystem::path &program, int error) {
    if (error == ENOMEM)
        throw Error(ErrorCode::outOfMemory, because::noMemoryForADecoder);
    throw Error(ErrorCode::internal,
                because::decoderCannotStart(error == 0 ? because::doesNotAnswer
                                                       : task::systemReason(error)),
                program);
}

std::atomic<std::uint64_t> grantedBytes = 0; // of all arenas

// Moves it above the numbers that the decoder starts with, so that none of them is overwritten.
Descriptor aboveReserved(int fd, const std::filesystem::path &program) {
    Descriptor low(fd);
    Descriptor high(fd < 0 ? -1 : ::fcntl(fd, F_DUPFD_CLOEXEC, 10));
    if (!high)
        failStarting(program, errno);
    return high;
}

// Passes on only the variables that are needed to find libraries.
std::vector<std::string> environment() {
    std::vector<std::string> kept;
    for (const char *const name : {"LD_LIBRARY_PATH", "DCMDICTPATH", "ASAN_OPTIONS", "TSAN_OPTIONS",
                                   "UBSAN_OPTIONS", "LLVM_PROFILE_FILE"})
        if (const char *const value = std::getenv(name))
            kept.push_back(std::string(name) + "=" + value);
    return kept;
}

} // namespace

namespace {

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
    if (m_pid <= 0)
        return;
    ::kill(m_pid, SIGKILL);
    while (::waitpid(m_pid, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void Child::start(const std::filesystem::path &program, const task::Progress &progress) {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        failStarting(program, errno);
    m_socket = aboveReserved(ends[0], program);
    Descriptor childSocket = aboveReserved(ends[1], program);
    m_arena =
        aboveReserved(::memfd_create("pellucid-decode", MFD_CLOEXEC | MFD_ALLOW_SEALING), program);
    // The arena must never shrink: reading beyond its end would kill the program.
    if (::ftruncate(m_arena.get(), off_t(firstArenaBytes)) != 0 ||
        ::fcntl(m_arena.get(), F_ADD_SEALS, F_SEAL_SHRINK) != 0)
        failStarting(program, errno);
    m_arenaBytes = firstArenaBytes;

    // The terminal's interrupt is for the program only, and signals start with their defaults.
    posix_spawnattr_t attributes;
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                POSIX_SPAWN_SETSIGDEF);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, childSocket.get(), socketDescriptor);
    ::posix_spawn_file_actions_adddup2(&actions, m_arena.get(), arenaDescriptor);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
#ifndef PELLUCID_SANITIZED // sanitizers report there
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
#endif
    std::string name = program.string();
    const std::array<char *, 2> arguments{name.data(), nullptr};
    std::vector<std::string> variables = environment();
    std::vector<char *> pointers;
    for (std::string &variable : variables)
        pointers.push_back(variable.data());
    pointers.push_back(nullptr);
    const int failed = ::posix_spawn(&m_pid, program.c_str(), &actions, &attributes,
                                     arguments.data(), pointers.data());
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
    if (failed != 0) {
        m_pid = -1;
        failStarting(program, failed);
    }
    childSocket = Descriptor(); // so that a closed end is noticed
    std::optional<Received> ready;
    allow(startSeconds);
    if (waitForMessage(progress))
        ready = receive(m_socket.get(), Takes::noDescriptors);
    if (!ready || ready->message.kind != Message::Kind::ready)
        failStarting(program, 0);
    m_confinement = ready->message.code;
    static std::once_flag once;
    std::call_once(once, [this] {
        system::log(std::string("decoders: resource limits ") +
                    ((m_confinement & limitsHold) != 0 ? "in force" : "NOT in force") +
                    ", system calls " +
                    ((m_confinement & callsAreFiltered) != 0 ? "filtered" : "NOT filtered"));
    });
    m_isUsable = true;
}

void Child::ask(const Message &request, int file) {
    allow(waitingSeconds(request));
    const bool isSent = send(m_socket.get(), request, file);
    m_isUsable = false; // until it has answered
    if (!isSent)
        throw Error(ErrorCode::unusable, because::decoderIsGone);
}

void Child::requestNext() {
    allow(waitingSeconds({Message::Kind::next, 0, 0, 0}));
    if (!send(m_socket.get(), {Message::Kind::next, 0, 0, 0}))
        failByExitStatus();
}

void Child::allow(double seconds) {
    m_end = Clock::now() +
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// Returns false after the deadline.
bool Child::waitForMessage(const task::Progress &progress) const {
    for (;;) {
        progress.check();
        pollfd waiting{m_socket.get(), POLLIN, 0};
        if (::poll(&waiting, 1, cancelPollMs) > 0)
            return true;
        if (Clock::now() > m_end)
            return false;
    }
}

Child::Answer Child::answer(const task::Progress &progress) {
    for (int memoryRequests = 0;;) {
        if (!waitForMessage(progress))
            throw Error(ErrorCode::unusable, because::takesTooLong);
        const auto received = receive(m_socket.get(), Takes::noDescriptors);
        if (!received)
            failByExitStatus();
        const Message &message = received->message;
        switch (message.kind) {
        case Message::Kind::need: {
            if (++memoryRequests > maxMemoryRequests) // a decoder that only asks for memory
                throw Error(ErrorCode::unusable, because::decodedToNonsense);
            const bool isGranted = grow(message.size);
            if (!send(m_socket.get(), {isGranted ? Message::Kind::granted : Message::Kind::refused,
                                       0, m_arenaBytes, 0}))
                failByExitStatus();
            break;
        }
        case Message::Kind::part:
        case Message::Kind::done:
            return take(message);
        default:
            throw Error(ErrorCode::unusable, because::decodedToNonsense);
        }
    }
}

// Memory is granted on this side, because the decoder is not trusted.
bool Child::grow(std::uint64_t bytes) {
    if (bytes <= m_arenaBytes)
        return true;
    // Other decoders may not have filled what they were granted.
    const std::uint64_t more = bytes - m_arenaBytes;
    const std::uint64_t granted = grantedBytes.fetch_add(more) + more;
    m_grantedBytes += more;
    if (granted > system::availableMemoryBytes() || ::ftruncate(m_arena.get(), off_t(bytes)) != 0) {
        grantedBytes -= more;
        m_grantedBytes -= more;
        return false;
    }
    m_arenaBytes = bytes;
    return true;
}

Child::Answer Child::take(const Message &message) {
    if (message.size > std::min(m_arenaBytes, largestBodyBytes) ||
        dataOffset(message.size) > m_arenaBytes ||
        message.dataBytes > m_arenaBytes - dataOffset(message.size))
        throw Error(ErrorCode::unusable, because::decodedToNonsense);
    if (m_mapped.size() < m_arenaBytes)
        m_mapped = Mapping(m_arena.get(), m_arenaBytes, Mapping::Access::read);
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
    // The process may need a moment to end after its socket closed. If it still runs then, it has
    // sent an invalid message.
    int status = 0;
    const auto end = Clock::now() + endPatience;
    for (pid_t ended = 0; ended != m_pid;) {
        ended = ::waitpid(m_pid, &status, WNOHANG);
        if (ended < 0 && errno != EINTR)
            break;
        if (ended == 0 && Clock::now() > end)
            throw Error(ErrorCode::unusable, because::decodedToNonsense);
        if (ended == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    m_pid = -1;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
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

} // namespace pellucid::decoder
