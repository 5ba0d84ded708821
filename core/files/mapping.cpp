// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/mapping.h"

#include <cerrno>
#include <sys/mman.h>

#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

Mapping::Mapping(int fd, std::size_t bytes, Access access) {
    if (bytes == 0)
        return;
    const int may = access == Access::write ? PROT_READ | PROT_WRITE : PROT_READ;
    void *const data = ::mmap(nullptr, bytes, may, MAP_SHARED, fd, 0);
    if (data == MAP_FAILED)
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::cannotBeMapped(task::systemReason(errno)));
    m_data = static_cast<std::byte *>(data);
    m_size = bytes;
}

Mapping::~Mapping() {
    if (m_data != nullptr)
        ::munmap(m_data, m_size);
}

} // namespace pellucid::files
