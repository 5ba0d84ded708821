// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/decoding/client/instance.h"

namespace pellucid::decoding {

/// A code of a terminology, such as SNOMED CT. *Source*: PS3.3, section 8.8.
struct CodedConcept {
    std::string value, scheme, meaning;
    bool operator==(const CodedConcept &) const = default;
};

/// A segment as a segmentation describes it. *Source*: PS3.3, section C.8.20.4.
struct SegmentDescription {
    int number = 0;
    std::string label;
    std::optional<glm::dvec3> color; ///< sRGB, each 0..1
    CodedConcept category, type;
    bool operator==(const SegmentDescription &) const = default;
};

/// How a segmentation stores its segments: a bit or a fraction for each pixel and segment, or one
/// segment number for each pixel.
enum class SegmentationKind : std::int32_t { binary, fractional, labelMap };

/// The header of a DICOM segmentation. Its frames have positions; `FrameHeader::segment` is the
/// segment that a frame shows, one of `segments`, or 0 for a label map.
struct SegmentationHeader {
    InstanceHeader instance;
    SegmentationKind kind = SegmentationKind::binary;
    int largestFraction = 255; ///< the value that means all of a pixel
    std::vector<SegmentDescription> segments;
};

/// Whether a file is a DICOM segmentation, or an RT structure set. *Source*: PS3.4, section B.5.
bool isSegmentation(const InstanceHeader &header);
bool isStructureSet(const InstanceHeader &header);

/// A region of interest of an RT structure set. *Source*: PS3.3, sections C.8.8.5 and C.8.8.6.
struct Structure {
    int number = 0;
    std::string name;
    std::optional<glm::dvec3> color;         ///< sRGB, each 0..1
    std::string type;                        ///< such as ORGAN or EXTERNAL; empty if unknown
    std::vector<std::uint32_t> contourSizes; ///< points of each closed planar contour, at least 3
    int ignoredContours = 0;                 ///< open ones and points, which enclose nothing
};

/// The header of an RT structure set, without the points of its contours.
struct StructureSetHeader {
    InstanceHeader instance;
    std::vector<Structure> structures;
};

/// The number of points of all contours.
std::uint64_t pointCount(const StructureSetHeader &header);

/// Limits on what is read: no known atlas has as many segments, no structure set as many points.
inline constexpr std::size_t maxSegments = 2000, maxContourPoints = 20'000'000;

} // namespace pellucid::decoding
