// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/files/mapping.h"

#include <system_error>

#include "core/files/reasons.h"
#include "core/task/error.h"

namespace pellucid::files {

Mapping::Mapping(platform::HandleView file, std::size_t bytes, Access access) {
    try {
        if (bytes > 0)
            m_mapped = platform::map(file, bytes, access);
    } catch (const std::system_error &error) {
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::cannotBeMapped(task::systemReason(error.code())));
    }
}

Mapping::~Mapping() {
    if (!m_mapped.empty())
        platform::unmap(m_mapped);
}

} // namespace pellucid::files
