// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/decoding/client/attribute.h"
#include "core/decoding/client/instance.h"
#include "core/decoding/client/segmentation_file.h"
#include "core/decoding/client/volume_layout.h"

namespace pellucid::decoding::process {

// The functions of `pellucid-decode`, for untrusted bytes. They use no path, file or process, and
// run confined. Other programs use `decoding::Decoder`.

/// The header of a DICOM file without its pixels. *Throws* Error{unusable} with the reason.
InstanceHeader parseHeader(std::span<const std::byte> file);

/// Parses a whole DICOM file and decodes every frame of it. *Throws* Error{unusable, outOfMemory}
/// with the reason.
DecodedImage decodeImage(std::span<const std::byte> file);

/// A DICOM segmentation. *Shape* of the pixels: frames x rows x columns, of a binary segmentation a
/// bit each, the lowest of a byte first, without a gap between rows or frames; of others 16-bit
/// values.
struct DecodedSegmentation {
    SegmentationHeader header;
    std::vector<std::byte> pixels;
};
/// *Throws* Error{unusable, outOfMemory} with the reason.
DecodedSegmentation decodeSegmentation(std::span<const std::byte> file);

/// An RT structure set. *Shape* of the points: x, y, z in patient space of every point, contour by
/// contour, structure by structure. *Units*: mm.
struct DecodedStructureSet {
    StructureSetHeader header;
    std::vector<double> points;
};
/// *Throws* Error{unusable, outOfMemory} with the reason.
DecodedStructureSet decodeStructureSet(std::span<const std::byte> file);

/// All attributes of a DICOM file in words; pixels and other bulk data only by their size. *Throws*
/// Error{unusable} with the reason.
AttributeList listAttributes(std::span<const std::byte> file);

/// The same DICOM file with uncompressed pixels. `syntaxUid`: Explicit or Implicit VR Little
/// Endian. *Throws* Error{unusable, outOfMemory} with the reason, also for images in color.
std::vector<std::byte> uncompress(std::span<const std::byte> file, const std::string &syntaxUid);

/// Whether it is a DICOMDIR, and the files that it lists. *Throws* Error{unusable} for a damaged
/// DICOMDIR.
DirectoryFile parseDirectory(std::span<const std::byte> file);

/// The header of a NRRD, NIfTI or MetaImage file. *Throws* Error{unusable} naming the damaged or
/// unsupported part.
VolumeLayout parseVolumeLayout(std::span<const std::byte> file);
/// Passes on samples in stored form, but in this machine's byte order, in parts of 1 MB. The last
/// part has the remainder, and tells whether the file continues. *Throws* Error{unusable} if there
/// are fewer samples, or the deflated data are damaged.
void readSamples(std::span<const std::byte> file, const SampleRange &samples,
                 const std::function<void(std::span<const std::byte>, bool hasMore)> &take);

/// Receives a part of the data of a file in an archive; `flags`: of decoding::ArchiveFlag.
using TakeData = std::function<void(const ArchiveFile &file, std::span<const std::byte> data,
                                    std::int32_t flags)>;
/// List the regular files of a ZIP archive; then pass on their data, in parts of at most
/// `decoding::archivePartBytes`. *Throws* Error{unusable} if it is damaged. If only the data of a
/// few files are damaged, their last part is marked and contains the encoded reason instead of
/// data.
void listArchive(std::span<const std::byte> archive,
                 const std::function<void(const ArchiveFile &)> &announce);
void readArchive(std::span<const std::byte> archive, const TakeData &take);

} // namespace pellucid::decoding::process
