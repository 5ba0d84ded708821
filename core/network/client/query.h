// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pellucid::network {

enum class Level : std::int32_t { study, series, image };

/// Attributes by tag, as text in UTF-8; backslashes separate values.
using Attributes = std::map<std::uint32_t, std::string>;

/// The tags that queries and answers use: group in the upper, element in the lower 16 bits.
namespace tag {
inline constexpr std::uint32_t sopClassUid = 0x00080016, sopInstanceUid = 0x00080018,
                               studyDate = 0x00080020, studyTime = 0x00080030,
                               accessionNumber = 0x00080050, modality = 0x00080060,
                               modalitiesInStudy = 0x00080061, sopClassesInStudy = 0x00080062,
                               referringPhysician = 0x00080090, studyDescription = 0x00081030,
                               seriesDescription = 0x0008103e, retrieveAe = 0x00080054,
                               availability = 0x00080056, patientName = 0x00100010,
                               patientId = 0x00100020, birthDate = 0x00100030, sex = 0x00100040,
                               bodyPart = 0x00180015, studyUid = 0x0020000d, seriesUid = 0x0020000e,
                               studyId = 0x00200010, seriesNumber = 0x00200011,
                               instanceNumber = 0x00200013, position = 0x00200032,
                               orientation = 0x00200037, spacing = 0x00280030,
                               seriesInStudy = 0x00201206, instancesInStudy = 0x00201208,
                               instancesInSeries = 0x00201209, rows = 0x00280010,
                               columns = 0x00280011, frames = 0x00280008;
}

/// Each answer is kept in memory.
inline constexpr std::uint32_t maxMatches = 1000000;

/// The most matches in one answer of a DICOMweb server.
inline constexpr std::uint32_t matchesOfPage = 200;

/// A search: the keys with a value restrict it, with the wildcards * and ?, and ranges of dates;
/// the others are returned.
struct Query {
    Level level = Level::study;
    Attributes keys;
    std::uint32_t limit =
        200; ///< the search is cancelled at the server when it is reached; 0: maxMatches
    std::uint32_t skip = 0; ///< matches of a DICOMweb server that are here already
};

/// The tag of the UIDs by which entries of a level are told apart.
constexpr std::uint32_t uidOf(Level level) {
    return level == Level::study    ? tag::studyUid
           : level == Level::series ? tag::seriesUid
                                    : tag::sopInstanceUid;
}

/// How a search ended.
struct QueryEnd {
    bool reachedLimit = false;         ///< that of the query
    bool mayBeIncomplete = false;      ///< the server has a limit, too, or says that there is more
    std::vector<std::string> warnings; ///< the server's warnings
};

/// What is to be retrieved: a study, a series of it, or instances of the series.
struct Retrieval {
    Level level = Level::study;
    std::string studyUid, seriesUid;
    std::vector<std::string> instanceUids;
    std::string destinationAe; ///< of `move`
};

/// What the server says at the end of a retrieval.
struct RetrievalEnd {
    std::uint32_t completed = 0, failed = 0, warnings = 0;
    std::vector<std::string> failedInstances;
    std::string reason; ///< why some failed: an encoded task::Reason; empty if unknown
    bool operator==(const RetrievalEnd &) const = default;
};

/// An object that arrives.
struct Arrival {
    std::string sopClassUid, sopInstanceUid, transferSyntax;
    std::string callingAe; ///< of the sender, if this program is the server
};

/// The answers to whoever sends an object (C-STORE; PS3.4, B.2.3; PS3.7, annex C).
namespace status {
inline constexpr std::uint16_t success = 0x0000, outOfResources = 0xa700, notWanted = 0x0124,
                               notAsAnnounced = 0xa900, invalidInstance = 0x0117,
                               cannotUnderstand = 0xc000;
} // namespace status

/// A unique identifier: digits and dots, at most 64.
bool isUid(const std::string &text);

/// Percent-encodes all characters but ASCII letters, digits and these (RFC 3986).
std::string percentEncoded(const std::string &text, const char *plain = "-._~");

} // namespace pellucid::network
