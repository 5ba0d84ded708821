// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/decoder/instance.h"

namespace pellucid::parse {

using decoder::ArchiveFile;
using decoder::DecodedImage;
using decoder::DirectoryFile;
using decoder::FrameHeader;
using decoder::InstanceHeader;

// What `pellucid-decode` does with bytes that nobody vouches for. No path, no file, no process: all
// of it runs confined. Other programs ask `decoder::Decoder`.

/// The header of a DICOM file without its pixels. *Throws* Error{unusable} with the reason.
InstanceHeader parseHeader(std::span<const std::byte> file);

/// Parses a whole DICOM file and decodes every frame of it. *Throws* Error{unusable, outOfMemory}
/// with the reason.
DecodedImage decodeImage(std::span<const std::byte> file);

/// Whether it is a DICOMDIR, and what it lists. *Throws* Error{unusable} for a DICOMDIR that is
/// damaged.
DirectoryFile parseDirectory(std::span<const std::byte> file);

/// A part of the data of a file in an archive.
using TakeData = std::function<void(const ArchiveFile &file, std::span<const std::byte> data,
                                    bool isFirst, bool isLast)>;
/// The regular files that a ZIP archive announces; then their data, in parts of at most
/// `decoder::archivePartBytes`. *Throws* Error{unusable} if it is damaged.
void listArchive(std::span<const std::byte> archive,
                 const std::function<void(const ArchiveFile &)> &announce);
void readArchive(std::span<const std::byte> archive, const TakeData &take);

} // namespace pellucid::parse
