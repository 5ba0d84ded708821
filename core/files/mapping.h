// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "core/platform/file.h"

namespace pellucid::files {

/// The start of a file, or of memory that processes share, as bytes in memory. *Throws*
/// Error{outOfMemory}.
class Mapping {
public:
    using Access = platform::Access;
    Mapping() = default;
    Mapping(platform::HandleView file, std::size_t bytes, Access access);
    ~Mapping();
    Mapping(Mapping &&other) noexcept : m_mapped(std::exchange(other.m_mapped, {})) {}
    Mapping &operator=(Mapping &&other) noexcept {
        std::swap(m_mapped, other.m_mapped);
        return *this;
    }
    std::byte *data() const { return m_mapped.data(); }
    std::size_t size() const { return m_mapped.size(); }
    std::span<const std::byte> bytes() const { return m_mapped; }

private:
    std::span<std::byte> m_mapped;
};

} // namespace pellucid::files
