// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "gpu/handle.h"

namespace pellucid::gpu {

/// Memory on the card for uniform blocks and storage. Belongs to the context that is current when
/// it is made; move-only.
class Buffer {
public:
    Buffer() : m_name(makeBuffer()) {}

    /// Makes it at least so large; what was in it is lost if it grows. *Throws* Error{outOfMemory}.
    void fit(std::size_t bytes);
    /// Replaces what is in it. *Throws* Error{outOfMemory}.
    void upload(const void *data, std::size_t bytes);
    void bindStorage(int binding) const;
    void bindUniform(int binding) const;

private:
    BufferName m_name;
    std::size_t m_bytes = 0;
};

} // namespace pellucid::gpu
