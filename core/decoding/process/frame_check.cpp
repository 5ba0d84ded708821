// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/frame_check.h"

#include <algorithm>

#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;

int byteAt(std::span<const std::byte> bytes, std::size_t at) {
    return std::to_integer<int>(bytes[at]);
}

std::size_t bigEndian16(std::span<const std::byte> bytes, std::size_t at) {
    return std::size_t(byteAt(bytes, at)) << 8 | std::size_t(byteAt(bytes, at + 1));
}

std::size_t littleEndian32(std::span<const std::byte> bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t n = 0; n < 4; ++n)
        value |= std::size_t(byteAt(bytes, at + n)) << (8 * n);
    return value;
}

// The number of bytes that a segment unpacks to, up to `wanted`; `rest`: its unused bytes.
std::size_t unpackedBytes(std::span<const std::byte> segment, std::size_t wanted,
                          std::size_t &rest) {
    std::size_t at = 0, given = 0;
    while (given < wanted && at < segment.size()) {
        const int control = byteAt(segment, at++);
        if (control < 128) { // control + 1 literal bytes follow
            const std::size_t literal = std::min(std::size_t(control) + 1, segment.size() - at);
            given += literal;
            at += literal;
        } else if (control > 128 && at < segment.size()) { // the next byte is repeated
            given += std::size_t(257 - control);
            ++at;
        }
    }
    rest = segment.size() - at;
    return given;
}

} // namespace

void requireMatchesHeader(std::int64_t rows, std::int64_t columns, int components, int precision,
                          const InstanceHeader &expected) {
    const auto fail = [](const task::Reason &reason) {
        throw task::Error(task::ErrorCode::unusable, reason);
    };
    if (columns != expected.columns || rows != expected.rows)
        fail(because::frameHasOtherSize(columns, rows, expected.columns, expected.rows));
    if (components != 1)
        fail(because::frameHasColors(components));
    if (precision > expected.bitsAllocated)
        fail(because::frameHasOtherBits(precision, expected.bitsAllocated));
}

std::optional<JpegFrame> jpegFrame(std::span<const std::byte> frame) {
    std::size_t at = 0;
    while (at + 4 <= frame.size()) {
        if (byteAt(frame, at) != 0xFF) {
            ++at; // some writers put it before a marker
            continue;
        }
        const int marker = byteAt(frame, at + 1);
        if (marker == 0xFF) { // fill byte
            ++at;
            continue;
        }
        at += 2;
        const bool hasNoLength =
            marker == 0xD8 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7);
        if (hasNoLength || marker == 0x00)
            continue;
        if (marker == 0xDA || marker == 0xD9) // start of the pixels, or the end
            return std::nullopt;
        const bool isFrame = (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 &&
                              marker != 0xC8 && marker != 0xCC) ||
                             marker == 0xF7;
        if (isFrame && at + 8 <= frame.size())
            return JpegFrame{int(bigEndian16(frame, at + 3)), int(bigEndian16(frame, at + 5)),
                             byteAt(frame, at + 7), byteAt(frame, at + 2), marker};
        at += bigEndian16(frame, at);
    }
    return std::nullopt;
}

std::optional<task::Reason> whyIncompleteRle(std::span<const std::byte> frame, int rows,
                                             int columns, int bytesEach) {
    constexpr std::size_t headerBytes = 64;
    if (frame.size() < headerBytes)
        return because::runsHaveNoHeader;
    const std::size_t segments = littleEndian32(frame, 0);
    if (segments != std::size_t(bytesEach))
        return because::runsHaveOtherSegments(segments, bytesEach);
    const std::size_t wanted = std::size_t(rows) * std::size_t(columns);
    for (std::size_t n = 0; n < segments; ++n) {
        const std::size_t begin = littleEndian32(frame, 4 + 4 * n);
        const std::size_t end = n + 1 < segments ? littleEndian32(frame, 8 + 4 * n) : frame.size();
        if (begin < headerBytes || begin > end || end > frame.size())
            return because::runsHaveWrongOffsets;
        std::size_t rest = 0;
        const std::size_t given = unpackedBytes(frame.subspan(begin, end - begin), wanted, rest);
        if (given != wanted)
            return because::runSegmentIsShort(given, wanted);
        // A segment of odd length is padded, and some writers add more.
        const auto padding = frame.subspan(end - rest, rest);
        if (std::any_of(padding.begin(), padding.end(),
                        [](std::byte b) { return b != std::byte(0) && b != std::byte(128); }))
            return because::runSegmentIsLong(rest);
    }
    return std::nullopt;
}

} // namespace pellucid::decoding::process
