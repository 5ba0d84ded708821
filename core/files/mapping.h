// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace pellucid::files {

/// The start of a file, or of memory that processes share, as bytes in memory. *Throws*
/// Error{outOfMemory}.
class Mapping {
public:
    enum class Access { read, write };
    Mapping() = default;
    Mapping(int fd, std::size_t bytes, Access access);
    ~Mapping();
    Mapping(Mapping &&other) noexcept
        : m_data(std::exchange(other.m_data, nullptr)), m_size(std::exchange(other.m_size, 0)) {}
    Mapping &operator=(Mapping &&other) noexcept {
        std::swap(m_data, other.m_data);
        std::swap(m_size, other.m_size);
        return *this;
    }
    std::byte *data() const { return m_data; }
    std::size_t size() const { return m_size; }
    std::span<const std::byte> bytes() const { return {m_data, m_size}; }

private:
    std::byte *m_data = nullptr;
    std::size_t m_size = 0;
};

} // namespace pellucid::files
