// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/next_connect.h"

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace {

bool isSkipped = false;

} // namespace

void pellucid::platform::skipNextConnect() {
    isSkipped = true;
}

// The linker puts this function in place of libc's.
extern "C" int connect(int socket, const sockaddr *address, socklen_t size) {
    if (std::exchange(isSkipped, false))
        return 0;
    sockaddr_storage peer{};
    socklen_t peerSize = sizeof peer;
    if (::getpeername(socket, reinterpret_cast<sockaddr *>(&peer), &peerSize) == 0)
        return 0;
    return int(::syscall(SYS_connect, socket, address, size));
}
