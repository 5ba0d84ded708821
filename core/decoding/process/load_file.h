// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

class DcmFileFormat;
class DcmDataset;

namespace pellucid::decoding::process {

/// A file as read by DCMTK.
struct LoadedFile {
    LoadedFile();
    ~LoadedFile();
    LoadedFile(LoadedFile &&) noexcept;

    DcmDataset &dataset() const;

    std::unique_ptr<DcmFileFormat> format;
    std::string syntaxUid;      ///< as stated in the file; empty if missing
    std::uint32_t oddities = 0; ///< of Oddity
    bool isComplete = true;     ///< false: reading ended early
    std::string failure;        ///< why it ended
};

/// How much of a deflated file is inflated: a header ends where the pixels start. For a header,
/// values above 4 KiB of other files are not loaded.
enum class Extent { header, everything };

/// *Throws* Error{unusable} if there is no DICOM data set, Error{outOfMemory}.
LoadedFile loadFile(std::span<const std::byte> bytes, Extent extent);

/// Transfer syntaxes by UID, including those that DCMTK does not know.
bool isJpeg2000(const std::string &syntaxUid); ///< or High-Throughput JPEG 2000
bool isJpegXl(const std::string &syntaxUid);
/// Whether pixels are plain samples, deflated or not; unknown syntaxes count as compressed.
bool isNative(const std::string &syntaxUid);
/// Whether this program can decode the pixels of a syntax. `decodeImage` decodes them.
bool isDecodable(const std::string &syntaxUid);
/// A readable name, or the UID if there is none.
std::string syntaxName(const std::string &syntaxUid);

} // namespace pellucid::decoding::process
