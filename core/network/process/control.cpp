// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/process/control.h"

#include <algorithm>
#include <cstdint>
#include <system_error>

#include "core/platform/file.h"

namespace pellucid::network::process {

std::string shortened(const std::string &text, std::size_t bytes) {
    std::size_t end = std::min(text.size(), bytes);
    while (end > 0 && end < text.size() && (std::uint8_t(text[end]) & 0xc0) == 0x80)
        --end; // within a character
    return text.substr(0, end);
}

void Control::send(const Message &message) {
    if (!network::send(m_channel, message))
        throw Disconnected();
}

Packet Control::wait() {
    auto packet = receive(m_channel);
    if (!packet)
        throw Disconnected();
    return *std::move(packet);
}

bool Control::isCancelled() {
    if (!m_channel.awaitPacket(0))
        return false;
    return wait().message.kind == Message::Kind::cancel;
}

void Control::heartbeat(std::uint64_t bytes) {
    const auto now = std::chrono::steady_clock::now();
    if (now - m_lastBeat < std::chrono::seconds(1))
        return;
    m_lastBeat = now;
    send({Message::Kind::progress, 0, bytes, {}});
}

void Control::step(Step step, const std::string &found) {
    send({Message::Kind::step, std::int32_t(step), 0, shortened(found, longestComment)});
}

void Control::match(const Query &query, Attributes attributes) {
    std::erase_if(attributes, [&](const auto &one) {
        return !query.keys.contains(one.first) && one.first != tag::retrieveAe &&
               one.first != tag::availability;
    });
    for (auto &[tag, value] : attributes) // the other half is for tags and lengths
        value = shortened(value, largestPacket / 2 / attributes.size());
    send({Message::Kind::match, 0, 0, pack(attributes)});
}

void Control::done(const std::string &body) {
    send({Message::Kind::done, 0, 0, body});
}

void Control::failed(Failure failure, const task::Reason &reason) {
    send({Message::Kind::failed, std::int32_t(failure), 0, reason.encoded()});
}

Storage::Storage(Control &control, const Arrival &arrival) : m_control(control) {
    m_control.send({Message::Kind::arrival, 0, 0, pack(arrival)});
    Packet packet = answer();
    if (packet.message.kind == Message::Kind::refused)
        m_status = std::uint16_t(packet.message.code);
    else if (packet.message.kind == Message::Kind::file && packet.handle)
        m_file = std::move(packet.handle);
    else
        throw Disconnected();
}

Packet Storage::answer() {
    Packet packet = m_control.wait();
    if (packet.message.kind == Message::Kind::cancel)
        throw CancelledByProgram();
    return packet;
}

void Storage::write(std::span<const std::byte> bytes) {
    constexpr std::uint64_t reportedAtOnce = 4 << 20;
    m_bytes += bytes.size();
    try {
        if (!m_hasFailed)
            platform::writeAll(m_file, bytes);
    } catch (const std::system_error &) {
        m_hasFailed = true;
    }
    if (m_bytes - m_reported < reportedAtOnce) {
        m_control.heartbeat(m_bytes);
        return;
    }
    m_reported = m_bytes;
    m_control.send({Message::Kind::progress, 0, m_bytes, {}});
}

std::uint16_t Storage::finish() {
    m_file = platform::Handle();
    if (m_hasFailed)
        m_bytes = 0; // nothing that the program could keep
    m_control.send({Message::Kind::received, 0, m_bytes, {}});
    const Packet packet = answer();
    if (packet.message.kind == Message::Kind::kept)
        return status::success;
    if (packet.message.kind != Message::Kind::refused)
        throw Disconnected();
    return std::uint16_t(packet.message.code);
}

} // namespace pellucid::network::process
