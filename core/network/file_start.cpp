// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/network/file_start.h"

#include <cstdint>
#include <cstring>
#include <string>

#include "core/task/error.h"

namespace pellucid::network {

namespace {

constexpr std::size_t preamble = 132, longestMetaHeader = 64 << 10;

[[noreturn]] void fail() {
    throw task::Error(task::ErrorCode::unusable, task::because::isNotDicom);
}

template <class T> T little(std::span<const std::byte> bytes, std::size_t at) {
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::string textAt(std::span<const std::byte> bytes, std::size_t at, std::size_t length) {
    std::string text(reinterpret_cast<const char *>(bytes.data()) + at, length);
    while (!text.empty() && (text.back() == '\0' || text.back() == ' '))
        text.pop_back();
    return text;
}

} // namespace

std::optional<exchange::Arrival> arrivalOf(std::span<const std::byte> start) {
    if (start.size() < preamble)
        return std::nullopt;
    if (std::memcmp(start.data() + preamble - 4, "DICM", 4) != 0)
        fail();
    exchange::Arrival arrival;
    for (std::size_t at = preamble;;) {
        // Explicit VR little endian: tag, VR, and a length of two or, for some VRs, four bytes.
        if (start.size() < at + 12) {
            if (at > longestMetaHeader)
                fail();
            return std::nullopt;
        }
        const auto group = little<std::uint16_t>(start, at),
                   element = little<std::uint16_t>(start, at + 2);
        if (group != 0x0002)
            break;
        const std::string vr = textAt(start, at + 4, 2);
        const bool isLong = vr == "OB" || vr == "OW" || vr == "UN" || vr == "UT" || vr == "SQ";
        const std::size_t length =
            isLong ? little<std::uint32_t>(start, at + 8) : little<std::uint16_t>(start, at + 6);
        const std::size_t value = at + (isLong ? 12 : 8);
        if (length > longestMetaHeader)
            fail();
        if (start.size() < value + length)
            return std::nullopt;
        if (element == 0x0002)
            arrival.sopClassUid = textAt(start, value, length);
        else if (element == 0x0003)
            arrival.sopInstanceUid = textAt(start, value, length);
        else if (element == 0x0010)
            arrival.transferSyntax = textAt(start, value, length);
        at = value + length;
    }
    if (!exchange::isUid(arrival.sopClassUid) || !exchange::isUid(arrival.sopInstanceUid) ||
        !exchange::isUid(arrival.transferSyntax))
        fail();
    return arrival;
}

} // namespace pellucid::network
