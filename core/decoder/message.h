// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/decoder/instance.h"
#include "core/decoder/volume_layout.h"
#include "core/task/reason.h"

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
        layout,  ///< the header of a file that holds volumes
        samples, ///< `dataBytes`: all of them, `code`: the size of one and bits of `SampleFlag`
        granted, ///< `size`: of the arena now
        refused,
        next, ///< part of an archive or of samples
        // from it
        ready = 100, ///< it is confined, see `Confinement`, in `code`
        need,        ///< `size`: of the arena
        part,        ///< `size` bytes of body, then `dataBytes`; of an archive with bits of
                     ///< `ArchiveFlag` in `code`
        done,        ///< `code`, `size` bytes of body, then `dataBytes`
    };
    Kind kind = Kind::ready;
    std::int32_t code = 0;       ///< of `done`: 0, or a `Refusal` whose reason is the body
    std::uint64_t size = 0;      ///< of the body
    std::uint64_t dataBytes = 0; ///< of what lies after it
    /// Of samples: where they begin in the file, and what is to be skipped once it is inflated.
    std::uint64_t at = 0, skip = 0;
};

/// `Message::code` of a `done` without an answer.
enum Refusal : std::int32_t { isUnusable = 1, needsMemory = 2 };

/// Bits of `Message::code` of `ready`.
enum Confinement : std::int32_t { limitsHold = 1, callsAreFiltered = 2 };

/// Bits of `Message::code` of `part`. An announcement has a list of files for a body, the others
/// the file that the data are of.
enum ArchiveFlag : std::int32_t { announcement = 1, firstPart = 2, lastPart = 4, damagedPart = 8 };

/// A bit of `Message::code` of the last `part` of samples: the file holds more of them.
inline constexpr std::int32_t moreFollows = 8;

/// Bits of `Message::code` of `samples`, beside the size of a sample.
enum SampleFlag : std::int32_t { deflated = 16, swapped = 32 };

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
std::string pack(const VolumeLayout &layout);
VolumeLayout unpackLayout(std::span<const std::byte> body);
/// As `task::Reason::encoded` gives it, unless it is endless; its texts become one printable line.
task::Reason unpackReason(std::span<const std::byte> body);

} // namespace pellucid::decoder
