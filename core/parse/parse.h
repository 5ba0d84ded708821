// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/decoder/instance.h"
#include "core/decoder/volume_layout.h"

namespace pellucid::parse {

using decoder::ArchiveFile;
using decoder::DecodedImage;
using decoder::DirectoryFile;
using decoder::FrameHeader;
using decoder::InstanceHeader;
using decoder::SampleRange;
using decoder::VolumeLayout;

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

/// The header of a NRRD, NIfTI or MetaImage file. *Throws* Error{unusable} naming what is damaged
/// or not supported.
VolumeLayout parseVolumeLayout(std::span<const std::byte> file);
/// Samples as they are stored, in this machine's byte order, in parts of 1 MB; the last is what is
/// left, and says whether the file goes on behind it. *Throws* Error{unusable} if there are fewer,
/// or what is deflated is damaged.
void readSamples(std::span<const std::byte> file, const SampleRange &samples,
                 const std::function<void(std::span<const std::byte>, bool hasMore)> &take);

/// A part of the data of a file in an archive; `flags`: of decoder::ArchiveFlag.
using TakeData = std::function<void(const ArchiveFile &file, std::span<const std::byte> data,
                                    std::int32_t flags)>;
/// The regular files that a ZIP archive announces; then their data, in parts of at most
/// `decoder::archivePartBytes`. *Throws* Error{unusable} if it is damaged, but for the data of a
/// few files: their last part is marked and holds the encoded reason in place of data.
void listArchive(std::span<const std::byte> archive,
                 const std::function<void(const ArchiveFile &)> &announce);
void readArchive(std::span<const std::byte> archive, const TakeData &take);

} // namespace pellucid::parse
