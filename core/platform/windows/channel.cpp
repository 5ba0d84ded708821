// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/channel.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/platform/windows/error.h"

namespace pellucid::platform {

namespace {

// Named pipes keep the boundaries of what is written at once. A handle is put into the process that
// reads before its number is sent.
struct Envelope {
    enum What : std::uint32_t { nothing, file, memory, socket } what = nothing;
    std::uint64_t number = 0;
    WSAPROTOCOL_INFOW socketInfo{};
};

constexpr std::size_t largestMessage = std::size_t(256) << 10;
// How long the reader may take.
constexpr DWORD busyMs = 50;

Handle newEvent() {
    Handle event = handleOf(::CreateEventW(nullptr, TRUE, FALSE, nullptr));
    if (!event)
        fail();
    return event;
}

std::optional<Envelope> envelopeFor(HandleView handle, HANDLE reader) {
    Envelope envelope;
    if (!handle)
        return envelope;
    if (handle.what() == Opened::socket) {
        envelope.what = Envelope::socket;
        const bool isMade = ::WSADuplicateSocketW(socketOf(handle), ::GetProcessId(reader),
                                                  &envelope.socketInfo) == 0;
        return isMade ? std::optional(envelope) : std::nullopt;
    }
    HANDLE there = nullptr;
    if (::DuplicateHandle(::GetCurrentProcess(), nativeOf(handle), reader, &there, 0, FALSE,
                          DUPLICATE_SAME_ACCESS) == FALSE)
        return std::nullopt;
    envelope.what = handle.what() == Opened::memory ? Envelope::memory : Envelope::file;
    envelope.number = std::uint64_t(reinterpret_cast<std::uintptr_t>(there));
    return envelope;
}

Handle handleIn(const Envelope &envelope) {
    switch (envelope.what) {
    case Envelope::file:
    case Envelope::memory:
        return Handle(Native(envelope.number),
                      envelope.what == Envelope::memory ? Opened::memory : Opened::file);
    case Envelope::socket: {
        useSockets();
        WSAPROTOCOL_INFOW info = envelope.socketInfo;
        return Handle(Native(::WSASocketW(FROM_PROTOCOL_INFO, FROM_PROTOCOL_INFO,
                                          FROM_PROTOCOL_INFO, &info, 0, WSA_FLAG_OVERLAPPED)),
                      Opened::socket);
    }
    case Envelope::nothing:
        break;
    }
    return {};
}

} // namespace

// The next packet, which is read in advance: a pipe tells nobody else that it has one.
struct Channel::Reading {
    Handle event = newEvent();
    OVERLAPPED state{};
    std::vector<std::byte> bytes = std::vector<std::byte>(largestMessage);
    bool isPending = false;

    void start(HANDLE pipe) {
        if (isPending)
            return;
        state = {};
        state.hEvent = nativeOf(event);
        ::ResetEvent(state.hEvent);
        isPending = true;
        if (::ReadFile(pipe, bytes.data(), DWORD(bytes.size()), nullptr, &state) == FALSE &&
            ::GetLastError() != ERROR_IO_PENDING && ::GetLastError() != ERROR_MORE_DATA)
            ::SetEvent(state.hEvent); // the end
    }
    bool isThereWithin(DWORD milliseconds) const {
        return ::WaitForSingleObject(nativeOf(event), milliseconds) == WAIT_OBJECT_0;
    }
};

Channel::Channel(Handle end) : m_end(std::move(end)), m_reading(std::make_shared<Reading>()) {}

Channel::~Channel() {
    if (!m_reading || !m_reading->isPending || !m_end)
        return;
    ::CancelIoEx(nativeOf(m_end), &m_reading->state);
    DWORD got = 0;
    ::GetOverlappedResult(nativeOf(m_end), &m_reading->state, &got, TRUE);
}

Channel &Channel::operator=(Channel &&other) noexcept {
    std::swap(m_end, other.m_end);
    std::swap(m_reader, other.m_reader);
    std::swap(m_reading, other.m_reading);
    return *this;
}

bool Channel::send(std::span<const std::byte> head, std::span<const std::byte> body,
                   HandleView handle, WhenBusy whenBusy) const {
    const auto envelope = envelopeFor(handle, reinterpret_cast<HANDLE>(m_reader));
    if (!envelope)
        return false;
    std::vector<std::byte> bytes(sizeof(Envelope) + head.size() + body.size());
    std::memcpy(bytes.data(), &*envelope, sizeof(Envelope));
    std::copy(head.begin(), head.end(), bytes.begin() + sizeof(Envelope));
    std::copy(body.begin(), body.end(),
              bytes.begin() + std::ptrdiff_t(sizeof(Envelope) + head.size()));
    const Handle event = newEvent();
    OVERLAPPED state{};
    state.hEvent = nativeOf(event);
    const HANDLE pipe = nativeOf(m_end);
    DWORD written = 0;
    BOOL isSent = ::WriteFile(pipe, bytes.data(), DWORD(bytes.size()), nullptr, &state);
    if (isSent != FALSE || ::GetLastError() == ERROR_IO_PENDING) {
        if (whenBusy == WhenBusy::fail &&
            ::WaitForSingleObject(state.hEvent, busyMs) != WAIT_OBJECT_0)
            ::CancelIoEx(pipe, &state);
        isSent = ::GetOverlappedResult(pipe, &state, &written, TRUE);
    }
    if (isSent != FALSE && written == bytes.size())
        return true;
    if (envelope->what == Envelope::file || envelope->what == Envelope::memory)
        ::DuplicateHandle(reinterpret_cast<HANDLE>(m_reader),
                          reinterpret_cast<HANDLE>(std::uintptr_t(envelope->number)), nullptr,
                          nullptr, 0, FALSE, DUPLICATE_CLOSE_SOURCE);
    return false;
}

// A helper that has been taken over may name any number as a handle: the program takes none.
std::optional<ReceivedPacket> Channel::receive(std::span<std::byte> head, std::span<std::byte> body,
                                               Takes takes) const {
    m_reading->start(nativeOf(m_end));
    m_reading->isThereWithin(INFINITE);
    m_reading->isPending = false;
    DWORD got = 0;
    if (::GetOverlappedResult(nativeOf(m_end), &m_reading->state, &got, FALSE) == FALSE)
        return std::nullopt; // the end, or a packet that is too long
    Envelope envelope;
    if (got < sizeof envelope)
        return std::nullopt;
    std::memcpy(&envelope, m_reading->bytes.data(), sizeof envelope);
    const bool isProgram = m_reader != -1;
    ReceivedPacket received;
    if (!isProgram)
        received.handle = handleIn(envelope);
    const auto bytes = std::span(m_reading->bytes).subspan(sizeof envelope, got - sizeof envelope);
    if (bytes.size() < head.size() || bytes.size() - head.size() > body.size() ||
        (envelope.what != Envelope::nothing && (isProgram || takes == Takes::noHandles)))
        return std::nullopt;
    std::copy_n(bytes.begin(), head.size(), head.begin());
    std::copy(bytes.begin() + std::ptrdiff_t(head.size()), bytes.end(), body.begin());
    received.bytes = bytes.size();
    return received;
}

bool Channel::awaitPacket(int milliseconds) const {
    m_reading->start(nativeOf(m_end));
    return m_reading->isThereWithin(DWORD(milliseconds));
}

std::pair<Channel, Channel> makeChannel() {
    const std::wstring name = L"\\\\.\\pipe\\pellucid-" + randomName(32);
    PrivateSecurity mine;
    Handle own = handleOf(::CreateNamedPipeW(
        name.c_str(), PIPE_ACCESS_DUPLEX | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
        PIPE_TYPE_MESSAGE | PIPE_READMODE_MESSAGE | PIPE_REJECT_REMOTE_CLIENTS, 1, largestMessage,
        largestMessage, 0, mine.get()));
    if (!own)
        fail();
    Handle other = handleOf(
        ::CreateFileW(name.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_EXISTING,
                      FILE_FLAG_OVERLAPPED | SECURITY_SQOS_PRESENT | SECURITY_ANONYMOUS, nullptr));
    DWORD mode = PIPE_READMODE_MESSAGE;
    if (!other || ::SetNamedPipeHandleState(nativeOf(other), &mode, nullptr, nullptr) == FALSE)
        fail();
    return {Channel(std::move(own)), Channel(std::move(other))};
}

// A pipe and sockets cannot be awaited at once: the pipe is looked at in between.
std::vector<bool> awaitAny(const Channel &channel, std::span<const HandleView> sockets,
                           int milliseconds) {
    constexpr int sliceMs = 10;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    std::vector<WSAPOLLFD> waiting;
    for (const HandleView &socket : sockets)
        waiting.push_back({socketOf(socket), POLLRDNORM, 0});
    for (;;) {
        std::vector<bool> ready{channel.awaitPacket(0)};
        const int count = waiting.empty() ? 0
                                          : ::WSAPoll(waiting.data(), ULONG(waiting.size()),
                                                      ready[0] ? 0 : sliceMs);
        if (waiting.empty() && !ready[0])
            ready[0] = channel.awaitPacket(sliceMs);
        for (const WSAPOLLFD &each : waiting)
            ready.push_back(count > 0 && each.revents != 0);
        if (ready[0] || count > 0 || std::chrono::steady_clock::now() >= end)
            return ready;
    }
}

} // namespace pellucid::platform
