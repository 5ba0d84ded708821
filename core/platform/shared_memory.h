// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/platform/handle.h"

namespace pellucid::platform {

/// Memory that this program shares with a helper, which may write it but can neither grow nor
/// shrink it. All functions *throw* std::system_error.
class SharedMemory {
public:
    SharedMemory() = default;
    explicit SharedMemory(std::uint64_t bytes);

    HandleView view() const { return m_handle; }
    std::uint64_t bytes() const { return m_bytes; }
    /// Makes it larger. True if it is another memory now, without the contents of the former one:
    /// the helper needs the new handle.
    bool grow(std::uint64_t bytes);

private:
    Handle m_handle;
    std::uint64_t m_bytes = 0;
};

} // namespace pellucid::platform
