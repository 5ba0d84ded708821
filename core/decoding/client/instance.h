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

namespace pellucid::decoding {

/// Values beyond these are nonsense: a kilometre from the isocentre, a pixel of a nanometre or of
/// ten metres. The parser drops such attributes.
inline constexpr double farthestMm = 1e6, smallestSpacingMm = 1e-6, largestSpacingMm = 1e4,
                        largestRescale = 1e9;
inline constexpr std::size_t maxFrames = 100000; ///< in a file
inline constexpr int maxVolumes = 10000;         ///< in a file

/// Conversion of stored values: value = slope * stored + intercept, or a modality table.
struct Rescale {
    double slope = 1.0, intercept = 0.0;
    bool isSlopeZero = false; ///< in the header; some converters write 0 and mean 1
    /// False if the header's value is not a number or is nonsense.
    bool isSlopeReadable = true, isInterceptReadable = true;
    bool isSlopeStated = false, isInterceptStated = false; ///< in the header
    bool operator==(const Rescale &) const = default;
};

/// The attributes of a PET image that standardised uptake values are computed from. Texts are empty
/// and numbers are 0 where the file has none.
struct PetHeader {
    std::string units;           ///< Units: BQML, GML, CNTS ...
    std::string uptakeType;      ///< SUVType: BW, LBM ...
    std::string decayCorrection; ///< NONE, START or ADMIN
    std::string seriesDate, seriesTime, acquisitionDate, acquisitionTime;
    std::string injectionTime, injectionDateTime; ///< RadiopharmaceuticalStart(Date)Time
    std::string timezone;                         ///< TimezoneOffsetFromUTC of the file's times
    std::string radionuclide;                     ///< the meaning of its code
    double weightKg = 0.0, injectedBq = 0.0, halfLifeS = 0.0;
    /// FrameReferenceTime, from the start that a decay correction refers to; ActualFrameDuration.
    double frameReferenceS = 0.0, frameDurationS = 0.0;
    int injections = 0;          ///< items of the sequence that describes them
    double uptakePerCount = 0.0; ///< Philips' private factor (7053,1000)
    std::string corrections;     ///< Corrected Image: ATTN, DECY ..., joined with backslashes
    bool isDynamic = false;      ///< Series Type is DYNAMIC
    bool operator==(const PetHeader &) const = default;
};

/// The attributes of one frame.
struct FrameHeader {
    std::optional<glm::dvec3> positionMm;          ///< ImagePositionPatient
    std::optional<glm::dvec3> rowAxis, columnAxis; ///< ImageOrientationPatient, normalised
    std::optional<glm::dvec2> spacingMm; ///< distance between columns, distance between rows
    double sliceThicknessMm = 0.0;       ///< 0 if unknown
    Rescale rescale;
    int segment = 0; ///< ReferencedSegmentNumber of a segmentation's frame; 0: none
    /// What can tell volumes at the same positions apart: those of `decoding::dimensions` that the
    /// frame has, by tag. Several values are joined with backslashes.
    std::map<std::uint32_t, std::string> dimensions;

    std::string imageType() const; ///< ImageType or FrameType; empty if it is missing
};

/// Violations of the standard that are tolerated. Bits.
enum Oddity : std::uint32_t {
    mislabelledEncoding = 1, ///< no value representations although the transfer syntax has them
    definedLengthPixels = 2, ///< in a compressed syntax
    missingDelimiter = 4,    ///< at the end of compressed pixels
    otherPrecision = 8,      ///< compressed values need more bits than the header says
    unreadMosaic = 16,       ///< a Siemens mosaic without a valid number of slices
    guessedMosaic = 32,      ///< the same, whose tiles were found by the acquisition matrix
    placedBySpacing = 64,    ///< one position for all frames, which were placed by their spacing
    placedByThickness = 128, ///< the same, without a spacing
    decimalCommas = 256,
    numbersOfWrongType = 512, ///< decimal numbers under another value representation
    allOddities = 1023
};

/// The attributes of a file.
struct InstanceHeader {
    std::string sopClassUid, sopClassName, sopInstanceUid, transferSyntax;
    std::string unsupportedSyntax; ///< the name or UID of a syntax that cannot be decoded
    std::string patientId, patientName, birthDate, sex;
    std::string studyUid, studyDate, studyDescription, frameOfReferenceUid;
    std::string seriesUid, seriesDescription, modality, bodyPart;
    int seriesNumber = 0, instanceNumber = 0;
    bool hasPixels = false, floatPixels = false;
    int rows = 0, columns = 0, samplesPerPixel = 1;
    int declaredFrames = 1;       ///< NumberOfFrames, whether or not the file has them
    std::uint32_t pixelBytes = 0; ///< of uncompressed pixels, as their element states; 0: unknown
    int bitsAllocated = 0, bitsStored = 0, highBit = 0;
    int pixelRepresentation = 0; ///< 0: unsigned, 1: signed, -1: missing
    bool lossy = false;
    bool hasDamagedPixels = false; ///< as far as the decoder noticed; it continued
    std::uint32_t oddities = 0;    ///< of `Oddity`
    /// Tiles along a side of a Siemens mosaic, whose tiles are the frames; 0: not a mosaic. Rows
    /// and columns are those of a tile.
    int mosaicSide = 0;
    std::string photometric, rescaleType;
    bool isInverse = false; ///< Presentation LUT Shape is INVERSE
    volume::SpacingPlace spacingPlace = volume::SpacingPlace::patient;
    std::optional<int> paddingValue, paddingLimit;
    std::optional<PetHeader> pet; ///< of a PET image
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

/// Whether a file has more uncompressed pixels than its header describes, whichever of its frames
/// are used; a single byte is padding.
bool hasSurplusPixels(const InstanceHeader &header);

/// Whether an image needs far more memory than its file has bytes, or is so large, that it is
/// opened only on request.
bool isHuge(const InstanceHeader &header, std::uint64_t fileBytes);

/// Why a file's pixels cannot be part of a volume or an image set, or nothing if they can.
std::optional<task::Reason> whyUnusable(const InstanceHeader &header);
/// Why monochrome pixels of 8 or 16 bits cannot be decoded, whatever the file is.
std::optional<task::Reason> whyUndecodable(const InstanceHeader &header);

/// The contents of a DICOMDIR, or a DICOM file that is not one.
struct DirectoryFile {
    bool isDirectory = false;
    /// For each listed file, in order, the unmodified components of its name.
    std::vector<std::vector<std::string>> files;
};

/// A file in an archive, as the archive lists it.
struct ArchiveFile {
    std::string name;
    std::uint64_t bytes = 0;
    bool isEncrypted = false;
    bool isLink = false; ///< listed, but never extracted
};

} // namespace pellucid::decoding
