// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "core/decoder/message.h"
#include "core/files/descriptor.h"
#include "core/helper/packet.h"

namespace pellucid::decoder {

using files::Descriptor;

/// Sends a message, and a descriptor unless it is -1; never blocks. False if the other end is
/// closed or does not read.
bool send(int socket, const Message &message, int descriptor = -1);

/// Waits for a message. Empty if the other end is closed, or sent something else.
struct Received {
    Message message;
    Descriptor descriptor;
};
using helper::Takes;
std::optional<Received> receive(int socket, Takes takes);

/// Part of a file or of an arena in memory. *Throws* Error{outOfMemory}.
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

} // namespace pellucid::decoder
