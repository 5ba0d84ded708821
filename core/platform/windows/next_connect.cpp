// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/next_connect.h"

#include <utility>

#include "core/platform/windows/error.h"

namespace {

bool isSkipped = false;

// The system's has to be asked for by name: the linker's name for it is the one below.
int connectOfSystem(SOCKET socket, const sockaddr *address, int size) {
    using Function = int(WSAAPI *)(SOCKET, const sockaddr *, int);
    static const auto system = reinterpret_cast<Function>(
        reinterpret_cast<void *>(::GetProcAddress(::GetModuleHandleW(L"ws2_32.dll"), "connect")));
    return system(socket, address, size);
}

int WSAAPI connectOrStay(SOCKET socket, const sockaddr *address, int size) {
    if (std::exchange(isSkipped, false))
        return 0;
    sockaddr_storage peer{};
    int peerSize = sizeof peer;
    if (::getpeername(socket, reinterpret_cast<sockaddr *>(&peer), &peerSize) == 0)
        return 0;
    return connectOfSystem(socket, address, size);
}

} // namespace

void pellucid::platform::skipNextConnect() {
    isSkipped = true;
}

// What programs call through the table of imported functions, in place of the system's.
extern "C" {
int(WSAAPI *__imp_connect)(SOCKET, const sockaddr *, int) = connectOrStay;
}
