// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/shared_memory.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace pellucid::platform {

namespace {

[[noreturn]] void fail() {
    throw std::system_error(errno, std::generic_category());
}

} // namespace

// It never shrinks: reading beyond its end would kill the program.
SharedMemory::SharedMemory(std::uint64_t bytes) : m_bytes(bytes) {
    // Above the standard streams, which may be closed: prints would go into it.
    constexpr int aboveStreams = 10;
    const Handle lowest(::memfd_create("pellucid", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    m_handle =
        Handle(lowest ? ::fcntl(lowest.get(), F_DUPFD_CLOEXEC, aboveStreams) : -1, Opened::memory);
    if (!m_handle || ::ftruncate(m_handle.get(), off_t(bytes)) != 0 ||
        ::fcntl(m_handle.get(), F_ADD_SEALS, F_SEAL_SHRINK) != 0)
        fail();
}

bool SharedMemory::grow(std::uint64_t bytes) {
    if (::ftruncate(m_handle.get(), off_t(bytes)) != 0)
        fail();
    m_bytes = bytes;
    return false;
}

} // namespace pellucid::platform
