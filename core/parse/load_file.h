// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

class DcmFileFormat;
class DcmDataset;

namespace pellucid::parse {

/// A file as DCMTK read it.
struct LoadedFile {
    LoadedFile();
    ~LoadedFile();
    LoadedFile(LoadedFile &&) noexcept;

    DcmDataset &dataset() const;

    std::unique_ptr<DcmFileFormat> format;
    std::string syntaxUid;      ///< as the file states it; empty if it states none
    std::uint32_t oddities = 0; ///< of decoder::Oddity
    bool isComplete = true;     ///< false: something in it ended the reading
    std::string failure;        ///< and what
};

/// How much of a deflated file is inflated: a header ends where the pixels begin. Values above 4
/// KiB of other files stay where they are for a header.
enum class Extent { header, everything };

/// *Throws* Error{unusable} if there is no DICOM data set, Error{outOfMemory}.
LoadedFile loadFile(std::span<const std::byte> bytes, Extent extent);

/// Transfer syntaxes by UID, whether or not DCMTK knows them.
bool isJpeg2000(const std::string &syntaxUid); ///< or High-Throughput JPEG 2000
bool isJpegXl(const std::string &syntaxUid);
/// Whether its pixels are plain samples, deflated or not; what is not known is compressed.
bool isNative(const std::string &syntaxUid);
/// Whether pixels of a syntax can be decoded.
bool isDecodable(const std::string &syntaxUid);
/// A name for people, or the UID where it has none.
std::string syntaxName(const std::string &syntaxUid);

} // namespace pellucid::parse
