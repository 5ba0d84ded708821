// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/platform/handle.h"

namespace pellucid::platform {

enum class WhenBusy { wait, fail };
enum class Takes { handle, noHandles };

struct ReceivedPacket {
    std::size_t bytes = 0; ///< of the head and the body
    Handle handle;
};

/// One end of a connection between a program and its helper, which keeps the boundaries of packets.
/// The program can send open files, sockets and memory along; a helper cannot.
class Channel {
public:
    Channel() = default;
    explicit Channel(Handle end);
    ~Channel();
    Channel(Channel &&other) noexcept = default;
    Channel &operator=(Channel &&other) noexcept;

    HandleView end() const { return m_end; }
    /// The process at the other end, for systems that put handles into it. It remains its owner's.
    void setReader(Native process) { m_reader = process; }
    explicit operator bool() const { return bool(m_end); }

    /// Sends a packet, a head and a body, and a handle if there is one. False if the other end is
    /// closed or, with `WhenBusy::fail`, does not read.
    bool send(std::span<const std::byte> head, std::span<const std::byte> body, HandleView handle,
              WhenBusy whenBusy) const;
    /// Waits for a packet and fills the head, then the body. Empty if the other end is closed, or
    /// the packet is shorter than the head or longer than both.
    std::optional<ReceivedPacket> receive(std::span<std::byte> head, std::span<std::byte> body,
                                          Takes takes) const;
    /// Whether a packet, or the end, can be read within so many milliseconds.
    bool awaitPacket(int milliseconds) const;

private:
    struct Reading; // of systems that can only begin to read
    Handle m_end;
    Native m_reader = -1;
    std::shared_ptr<Reading> m_reading;
};

/// A channel and its other end. *Throws* std::system_error.
std::pair<Channel, Channel> makeChannel();

/// Waits, at most so many milliseconds, until one of several can be read: a packet, or bytes or a
/// connection of a socket, or an end. *Returns* which can, the channel first.
std::vector<bool> awaitAny(const Channel &channel, std::span<const HandleView> sockets,
                           int milliseconds);

} // namespace pellucid::platform
