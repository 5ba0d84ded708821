// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/platform/shared_memory.h"

#include "core/platform/windows/error.h"

namespace pellucid::platform {

SharedMemory::SharedMemory(std::uint64_t bytes)
    : m_handle(handleOf(::CreateFileMappingW(INVALID_HANDLE_VALUE, nullptr, PAGE_READWRITE,
                                             DWORD(bytes >> 32), DWORD(bytes), nullptr),
                        Opened::memory)),
      m_bytes(bytes) {
    if (!m_handle)
        fail();
}

bool SharedMemory::grow(std::uint64_t bytes) {
    *this = SharedMemory(bytes);
    return true;
}

} // namespace pellucid::platform
