// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/decoding/client/attribute.h"
#include "core/decoding/client/instance.h"
#include "core/decoding/client/segmentation_file.h"
#include "core/decoding/client/volume_layout.h"
#include "core/task/reason.h"

namespace pellucid::decoding {

/// The messages between the program and its decoder, through a socket: a few numbers and sometimes
/// a file descriptor. All other data are in the arena.
struct Message {
    enum class Kind : std::uint32_t {
        // sent to the decoder; `size` is that of the file, whose descriptor is attached
        header = 1,
        image,
        directory,
        archive,
        layout,  ///< the header of a file that holds volumes
        samples, ///< `dataBytes`: in total; `code`: bytes each, and bits of `SampleFlag`
        granted, ///< `size`: of the arena now
        refused,
        next,         ///< part of an archive or of samples
        segmentation, ///< a DICOM segmentation
        structureSet, ///< an RT structure set
        attributes,   ///< all attributes of a DICOM file
        uncompressed, ///< the file with plain pixels; `code`: 1 with explicit value types, else 0
        // sent by the decoder
        ready = 100, ///< it is confined, see platform::Confinement, in `code`
        need,        ///< `size`: of the arena
        part,        ///< `size` bytes of body, then `dataBytes`; of an archive with bits of
                     ///< `ArchiveFlag` in `code`
        done,        ///< `code`, `size` bytes of body, then `dataBytes`
    };
    Kind kind = Kind::ready;
    std::int32_t code = 0;       ///< of `done`: 0, or a `Refusal` whose reason is the body
    std::uint64_t size = 0;      ///< of the body
    std::uint64_t dataBytes = 0; ///< of the data after the body
    /// For samples: the offset in the file, and the number of bytes to skip after inflating.
    std::uint64_t at = 0, skip = 0;
};

/// `Message::code` of a `done` without an answer.
enum Refusal : std::int32_t { isUnusable = 1, needsMemory = 2 };

/// Bits of `Message::code` of `part`. The body of an announcement is a list of files, that of other
/// parts the file that the data belong to.
enum ArchiveFlag : std::int32_t { announcement = 1, firstPart = 2, lastPart = 4, damagedPart = 8 };

/// A bit of `Message::code` of the last `part` of samples: the file has more of them.
inline constexpr std::int32_t moreFollows = 8;

/// Bits of `Message::code` of `samples`, in addition to the size of a sample.
enum SampleFlag : std::int32_t { deflated = 16, swapped = 32 };

/// Every part except the last of a file is full, and so is every announcement except the last.
inline constexpr std::size_t archivePartBytes = 1 << 20, filesAnnouncedAtOnce = 500;

/// The offset of the data in the arena: the first page after the body.
constexpr std::uint64_t dataOffset(std::uint64_t bodyBytes) {
    return (bodyBytes + 4095U) / 4096U * 4096U;
}

/// Packing of message bodies: InstanceHeader, DirectoryFile, lists of ArchiveFile, VolumeLayout,
/// SegmentationHeader, StructureSetHeader, AttributeList. Unpacking *throws* Error{unusable} if the
/// bytes are not such a body, whatever they are: a compromised decoder may send anything. It makes
/// the texts of attributes one printable line.
template <class T> std::string pack(const T &value);
template <class T> T unpack(std::span<const std::byte> body);
/// Reads the format of `task::Reason::encoded`, with a limit on its length. Texts are made one
/// printable line.
task::Reason unpackReason(std::span<const std::byte> body);

} // namespace pellucid::decoding
