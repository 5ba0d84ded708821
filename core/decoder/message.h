// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/decoder/instance.h"

namespace pellucid::decoder {

/// What goes through the socket between the program and its decoder: a few numbers, and at times a
/// file descriptor. All else lies in the arena.
struct Message {
    enum class Kind : std::uint32_t {
        // to the decoder; `size`: of the file, whose descriptor comes along
        header = 1,
        image,
        directory,
        archive,
        granted, ///< `size`: of the arena now
        refused,
        next, ///< part of an archive
        // from it
        ready = 100, ///< it is confined, see `Confinement`, in `code`
        need,        ///< `size`: of the arena
        part,        ///< of an archive: `size` bytes of body, then `dataBytes`; `code`: bits of
                     ///< `ArchiveFlag`
        done,        ///< `code`, `size` bytes of body, then `dataBytes`
    };
    Kind kind = Kind::ready;
    std::int32_t code = 0;       ///< 0, or a task::ErrorCode whose reason is the body
    std::uint64_t size = 0;      ///< of the body
    std::uint64_t dataBytes = 0; ///< of what lies after it
};

/// Bits of `Message::code` of `ready`.
enum Confinement : std::int32_t { limitsHold = 1, callsAreFiltered = 2 };

/// Bits of `Message::code` of `part`. An announcement has a list of files for a body, the others
/// the file that the data are of.
enum ArchiveFlag : std::int32_t { announcement = 1, firstPart = 2, lastPart = 4 };

/// A part that is not the last of its file is full; so is an announcement that is not the last.
inline constexpr std::size_t archivePartBytes = 1 << 20, filesAnnouncedAtOnce = 500;

/// Where the data begin in the arena: after the body, on a page.
constexpr std::uint64_t dataOffset(std::uint64_t bodyBytes) {
    return (bodyBytes + 4095U) / 4096U * 4096U;
}

/// Bodies. Reading *throws* Error{unusable} if the bytes are not such a body, whatever they are: a
/// decoder that a file has taken over may send anything.
std::string pack(const InstanceHeader &header);
InstanceHeader unpackHeader(std::span<const std::byte> body);
std::string pack(const DirectoryFile &directory);
DirectoryFile unpackDirectory(std::span<const std::byte> body);
std::string pack(const std::vector<ArchiveFile> &files);
std::vector<ArchiveFile> unpackArchiveFiles(std::span<const std::byte> body);
/// A reason: printable, one line, not endless.
std::string unpackReason(std::span<const std::byte> body);

} // namespace pellucid::decoder
