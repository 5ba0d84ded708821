// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "gpu/handle.h"

namespace pellucid::gpu {

/// A uniform or storage buffer on the card. Belongs to the context that is current when it is
/// created; move-only.
class Buffer {
public:
    Buffer() : m_name(makeBuffer()) {}

    /// Grows the buffer to at least `bytes`; growing discards the contents. *Throws*
    /// Error{outOfMemory}.
    void fit(std::size_t bytes);
    /// Replaces the contents. *Throws* Error{outOfMemory}.
    void upload(const void *data, std::size_t bytes);
    void bindStorage(int binding) const;
    void bindUniform(int binding) const;

private:
    BufferName m_name;
    std::size_t m_bytes = 0;
};

} // namespace pellucid::gpu
