// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/task/reason.h"
#include "core/volume/volume.h"

namespace pellucid::decoder {

/// Beyond these a number is rubbish: a kilometre from the isocentre, a pixel of a nanometre or of
/// ten metres. The parser leaves such attributes out.
inline constexpr double farthestMm = 1e6, smallestSpacingMm = 1e-6, largestSpacingMm = 1e4,
                        largestRescale = 1e9;
inline constexpr std::size_t mostFrames = 100000; ///< of a file
inline constexpr int mostVolumes = 10000;         ///< of a file

/// How stored values become values: value = slope * stored + intercept, or a modality table.
struct Rescale {
    double slope = 1.0, intercept = 0.0;
    bool isSlopeZero = false; ///< in the header; some converters write that, and mean 1
    /// False: what the header gives is no number, or rubbish.
    bool isSlopeReadable = true, isInterceptReadable = true;
    bool operator==(const Rescale &) const = default;
};

/// What a header says about one frame.
struct FrameHeader {
    std::optional<glm::dvec3> positionMm;          ///< ImagePositionPatient
    std::optional<glm::dvec3> rowAxis, columnAxis; ///< ImageOrientationPatient, normalised
    std::optional<glm::dvec2> spacingMm;           ///< distance of columns, distance of rows
    double sliceThicknessMm = 0.0;                 ///< 0 if unknown
    Rescale rescale;
    std::string imageType; ///< values joined with backslashes
    /// Attributes that can tell apart volumes at the same positions, by name: temporal position,
    /// acquisition, echo, ... Absent ones are missing.
    std::map<std::string, std::string> dimensions;
};

/// What a file does that the standard forbids, and that is read all the same. Bits.
enum Oddity : std::uint32_t {
    mislabelledEncoding = 1, ///< elements without representations under a syntax that has them
    definedLengthPixels = 2, ///< of a compressed syntax
    missingDelimiter = 4,    ///< at the end of compressed pixels
    otherPrecision = 8,      ///< compressed values need more bits than the header says
    unreadMosaic = 16,       ///< a Siemens mosaic without a usable number of slices
    allOddities = 31
};

/// What a header says about a file.
struct InstanceHeader {
    std::string sopClassUid, sopClassName, sopInstanceUid, transferSyntax;
    std::string unsupportedSyntax; ///< what cannot be decoded: its name, or its UID
    std::string patientId, patientName, birthDate, sex;
    std::string studyUid, studyDate, studyDescription, frameOfReferenceUid;
    std::string seriesUid, seriesDescription, modality, bodyPart;
    int seriesNumber = 0, instanceNumber = 0;
    bool hasPixels = false, floatPixels = false;
    int rows = 0, columns = 0, samplesPerPixel = 1;
    int announcedFrames = 1;      ///< NumberOfFrames, whether or not there is room for them
    std::uint32_t pixelBytes = 0; ///< of uncompressed pixels, as their element says; 0: not known
    int bitsAllocated = 0, bitsStored = 0, highBit = 0;
    int pixelRepresentation = 0; ///< 0: unsigned, 1: signed, -1: not said
    bool lossy = false;
    bool hasDamagedPixels = false; ///< as far as their decoder noticed, who went on
    std::uint32_t oddities = 0;    ///< of Oddity
    /// Tiles along a side of a Siemens mosaic, whose tiles are the frames; 0: it is none. Rows and
    /// columns are those of a tile.
    int mosaicSide = 0;
    std::string photometric, rescaleType;
    std::optional<int> paddingValue, paddingLimit;
    std::vector<volume::ValueWindow> windows;
    std::vector<std::uint16_t> modalityTable; ///< values, empty if there is none
    int modalityTableFirst = 0;
    std::vector<FrameHeader> frames; ///< at least one

    bool isSigned() const { return pixelRepresentation == 1; }
};

/// A decoded file: stored values, high bits masked, sign extended to 16 bits.
struct DecodedImage {
    InstanceHeader header;
    /// *Shape*: frames x rows x columns. Signed if header.isSigned().
    std::vector<std::uint16_t> samples;
};

/// Whether uncompressed pixels go on behind those that the header describes, whichever frames of it
/// are in use; a byte is padding.
bool hasSurplusPixels(const InstanceHeader &header);

/// Whether an image takes so much more memory than its file has bytes, or is so large, that it is
/// opened only when the user says so.
bool isHuge(const InstanceHeader &header, std::uint64_t fileBytes);

/// Why a file's pixels cannot be part of a volume or an image set, or nothing if they can.
std::optional<task::Reason> whyUnusable(const InstanceHeader &header);

/// A DICOMDIR, or a DICOM file that is none.
struct DirectoryFile {
    bool isDirectory = false;
    /// Of each file that it lists, in its order, the parts of its name; as they stand there.
    std::vector<std::vector<std::string>> files;
};

/// A file in an archive, as the archive says.
struct ArchiveFile {
    std::string name;
    std::uint64_t bytes = 0;
    bool isEncrypted = false;
    bool isLink = false; ///< announced, never given
};

} // namespace pellucid::decoder
