// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/socket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/platform/place.h"
#include "core/platform/windows/accepting.h"
#include "core/platform/windows/error.h"
// After winsock2.h.
#include <mswsock.h>

namespace pellucid::platform {

namespace {

int sizeOf(const Place &place) {
    return place.any.sa_family == AF_INET6 ? int(sizeof place.at6) : int(sizeof place.at4);
}

Handle newSocket(int family) {
    useSockets();
    return Handle(Native(::WSASocketW(family, SOCK_STREAM, IPPROTO_TCP, nullptr, 0,
                                      WSA_FLAG_OVERLAPPED | WSA_FLAG_NO_HANDLE_INHERIT)),
                  Opened::socket);
}

void setWaiting(HandleView socket, Accepting accepting) {
    u_long never = accepting == Accepting::neverWaits ? 1 : 0;
    ::ioctlsocket(socketOf(socket), long(FIONBIO), &never);
}

template <class T> void set(HandleView socket, int level, int option, T value) {
    ::setsockopt(socketOf(socket), level, option, reinterpret_cast<const char *>(&value),
                 sizeof value);
}

std::vector<Handle> &spareSockets() {
    static std::vector<Handle> all;
    return all;
}
bool hasOnlySpares = false;

// Accepts a connection that is already waiting.
std::optional<Connected> acceptInto(Handle socket, HandleView listening) {
    constexpr DWORD patienceMs = 100, addressBytes = sizeof(sockaddr_storage) + 16;
    std::array<char, 2 * std::size_t(addressBytes)> addresses{};
    const Handle event = handleOf(::CreateEventW(nullptr, TRUE, FALSE, nullptr));
    OVERLAPPED state{};
    state.hEvent = nativeOf(event);
    DWORD got = 0;
    BOOL isAccepted = ::AcceptEx(socketOf(listening), socketOf(socket), addresses.data(), 0,
                                 addressBytes, addressBytes, &got, &state);
    if (isAccepted == FALSE && ::WSAGetLastError() == ERROR_IO_PENDING) {
        if (::WaitForSingleObject(state.hEvent, patienceMs) != WAIT_OBJECT_0)
            ::CancelIoEx(nativeOf(listening), &state);
        isAccepted = ::GetOverlappedResult(nativeOf(listening), &state, &got, TRUE);
    }
    if (isAccepted == FALSE) { // it has gone
        spareSockets().push_back(std::move(socket));
        return std::nullopt;
    }
    set(socket, SOL_SOCKET, SO_UPDATE_ACCEPT_CONTEXT, socketOf(listening));
    sockaddr *own = nullptr, *other = nullptr;
    int ownBytes = 0, otherBytes = 0;
    ::GetAcceptExSockaddrs(addresses.data(), 0, addressBytes, addressBytes, &own, &ownBytes, &other,
                           &otherBytes);
    Place from;
    std::memcpy(&from.all, other, std::min(std::size_t(otherBytes), sizeof from.all));
    return Connected{std::move(socket), textOf(from), portOf(from)};
}

} // namespace

void makeSpareSockets(int count) {
    useSockets();
    hasOnlySpares = true;
    for (int n = 0; n < count; ++n)
        spareSockets().push_back(newSocket(AF_INET));
}

ListeningSocket listenOn(const std::string &address, int port, int waiting, Accepting accepting) {
    Place place = ownPlace(address, port);
    ListeningSocket listening{newSocket(place.any.sa_family)};
    const SOCKET socket = socketOf(listening.socket);
    // Windows lets a port that is in use be taken over, unless its owner refuses.
    set(listening.socket, SOL_SOCKET, SO_EXCLUSIVEADDRUSE, DWORD(1));
    if (place.any.sa_family == AF_INET6)
        set(listening.socket, IPPROTO_IPV6, IPV6_V6ONLY, DWORD(0));
    int size = sizeOf(place);
    if (!listening.socket || ::bind(socket, &place.any, size) != 0 ||
        ::listen(socket, waiting) != 0)
        failWith(DWORD(::WSAGetLastError()));
    size = sizeof place;
    if (::getsockname(socket, &place.any, &size) != 0)
        failWith(DWORD(::WSAGetLastError()));
    setWaiting(listening.socket, accepting);
    listening.port = portOf(place);
    return listening;
}

bool awaitInput(HandleView socket, int milliseconds) {
    WSAPOLLFD waiting{socketOf(socket), POLLRDNORM, 0};
    return ::WSAPoll(&waiting, 1, milliseconds) > 0;
}

std::optional<Connected> acceptFrom(HandleView listening, Accepting accepting) {
    if (hasOnlySpares) {
        if (spareSockets().empty())
            failWith(WSAEMFILE);
        Handle spare = std::move(spareSockets().back());
        spareSockets().pop_back();
        setWaiting(spare, accepting);
        return acceptInto(std::move(spare), listening);
    }
    Place from;
    int size = sizeof from;
    Handle socket(Native(::accept(socketOf(listening), &from.any, &size)), Opened::socket);
    if (!socket)
        return std::nullopt;
    setWaiting(socket, accepting);
    return Connected{std::move(socket), textOf(from), portOf(from)};
}

Handle connectTo(const std::string &address, int port, double seconds) {
    useSockets();
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICHOST; // with a scope, perhaps
    addrinfo *found = nullptr;
    if (::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0)
        failWith(WSAEINVAL);
    Handle socket = newSocket(found->ai_family);
    setWaiting(socket, Accepting::neverWaits);
    int error = 0;
    if (!socket ||
        ::connect(socketOf(socket), found->ai_addr, int(found->ai_addrlen)) == SOCKET_ERROR)
        error = ::WSAGetLastError();
    ::freeaddrinfo(found);
    if (error == WSAEWOULDBLOCK) { // WSAPoll does not report a refusal before Windows 10 2004
        fd_set connected, failed;
        FD_ZERO(&connected);
        FD_ZERO(&failed);
        FD_SET(socketOf(socket), &connected);
        FD_SET(socketOf(socket), &failed);
        timeval patience{long(seconds), long(std::fmod(seconds, 1.0) * 1e6)};
        int size = sizeof error;
        if (::select(0, nullptr, &connected, &failed, &patience) > 0)
            ::getsockopt(socketOf(socket), SOL_SOCKET, SO_ERROR, reinterpret_cast<char *>(&error),
                         &size);
        else
            error = WSAETIMEDOUT;
    }
    if (error != 0)
        failWith(DWORD(error));
    sendAtOnce(socket);
    return socket;
}

void makeWaiting(HandleView socket) {
    setWaiting(socket, Accepting::waits);
}

void sendLast(HandleView socket, std::string_view bytes) {
    ::send(socketOf(socket), bytes.data(), int(bytes.size()), 0);
    ::shutdown(socketOf(socket), SD_SEND);
}

std::optional<std::size_t> receiveSome(HandleView socket, std::span<char> to) {
    const int got = ::recv(socketOf(socket), to.data(), int(to.size()), 0);
    if (got >= 0)
        return std::size_t(got);
    return ::WSAGetLastError() == WSAEWOULDBLOCK ? std::nullopt : std::optional<std::size_t>(0);
}

bool otherEndHasHungUp() {
    const int error = ::WSAGetLastError();
    return error == WSAECONNRESET || error == WSAECONNABORTED || error == WSAESHUTDOWN;
}

void sendAtOnce(HandleView socket) {
    set(socket, IPPROTO_TCP, TCP_NODELAY, DWORD(1));
}

// Windows decides for a whole interface.
void acknowledgeAtOnce(HandleView) {}

} // namespace pellucid::platform
