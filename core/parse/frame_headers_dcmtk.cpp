// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/frame_headers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>

#include "core/parse/attributes.h"

namespace pellucid::parse {

namespace {

using decoder::FrameHeader;
using decoder::InstanceHeader;

std::optional<glm::dvec3> vector3(const std::vector<double> &v, std::size_t at) {
    if (v.size() < at + 3 || !std::isfinite(v[at] + v[at + 1] + v[at + 2]))
        return std::nullopt;
    return glm::dvec3(v[at], v[at + 1], v[at + 2]);
}

// Each of these may be at the top level of a file, in the shared groups, or in the groups of a
// frame.
void readOrientation(DcmItem *item, FrameHeader &frame) {
    const auto cosines = readNumbers(item, DCM_ImageOrientationPatient, 6);
    const auto row = vector3(cosines, 0), column = vector3(cosines, 3);
    // Both axes must be about unit length and about orthogonal, otherwise the attribute is
    // nonsense.
    if (row && column && std::abs(glm::length(*row) - 1.0) < 0.05 &&
        std::abs(glm::length(*column) - 1.0) < 0.05 && std::abs(glm::dot(*row, *column)) < 0.05) {
        frame.rowAxis = glm::normalize(*row);
        frame.columnAxis = glm::normalize(*column - glm::dot(*row, *column) * *row);
    }
}

void readPosition(DcmItem *item, FrameHeader &frame) {
    if (const auto position = vector3(readNumbers(item, DCM_ImagePositionPatient, 3), 0);
        position && glm::length(*position) <= decoder::farthestMm)
        frame.positionMm = position;
}

void readMeasures(DcmItem *item, FrameHeader &frame) {
    const auto spacing = readNumbers(item, DCM_PixelSpacing, 2);
    // The attribute gives the distance between rows first.
    if (spacing.size() == 2 && std::min(spacing[0], spacing[1]) >= decoder::smallestSpacingMm &&
        std::max(spacing[0], spacing[1]) <= decoder::largestSpacingMm)
        frame.spacingMm = glm::dvec2(spacing[1], spacing[0]);
    for (const DcmTagKey &tag : {DCM_SliceThickness, DCM_SpacingBetweenSlices})
        if (const auto mm = readNumber(item, tag); mm && *mm > 0.0)
            frame.sliceThicknessMm = *mm;
}

// Below this, all values would be equal.
constexpr double smallestRescale = 1e-30;

bool isMultiple(DcmItem *item, const DcmTagKey &tag) {
    DcmElement *element = nullptr;
    return item->findAndGetElement(tag, element).good() && element->getVM() > 1;
}

// An unusable value is recorded, because ignoring it changes the values.
void readRescale(DcmItem *item, FrameHeader &frame) {
    decoder::Rescale &rescale = frame.rescale;
    const auto take = [&](const DcmTagKey &tag, double &into, bool &isReadable) {
        if (readText(item, tag).empty()) // empty or missing
            return;
        const auto value = readNumber(item, tag);
        isReadable = value && std::abs(*value) <= decoder::largestRescale &&
                     (*value == 0.0 || std::abs(*value) >= smallestRescale) &&
                     !isMultiple(item, tag);
        if (isReadable)
            into = *value;
    };
    double slope = rescale.isSlopeZero ? 0.0 : rescale.slope;
    take(DCM_RescaleSlope, slope, rescale.isSlopeReadable);
    rescale.isSlopeZero = slope == 0.0;
    rescale.slope = rescale.isSlopeZero ? 1.0 : slope;
    take(DCM_RescaleIntercept, rescale.intercept, rescale.isInterceptReadable);
}

void readDimensions(DcmItem *item, FrameHeader &frame) {
    static const std::array<std::pair<const char *, DcmTagKey>, 12> tags{{
        {"temporal position", DCM_TemporalPositionIdentifier},
        {"temporal position", DCM_TemporalPositionIndex},
        {"acquisition", DCM_AcquisitionNumber},
        {"echo", DCM_EchoNumbers},
        {"echo", DCM_EchoTime},
        {"b-value", DCM_DiffusionBValue},
        {"b-value", DcmTagKey(0x0043, 0x1039)}, // GE's private attribute
        {"trigger time", DCM_TriggerTime},
        {"stack", DCM_StackID},
        {"acquisition time", DCM_AcquisitionTime},
        {"acquisition time", DCM_AcquisitionDateTime},
        {"content time", DCM_ContentTime},
    }};
    for (const auto &[name, tag] : tags)
        if (std::string value = readText(item, tag); !value.empty())
            frame.dimensions[name] = value;
}

void readFunctionalGroups(DcmItem *groups, FrameHeader &frame) {
    readOrientation(sequenceItem(groups, DCM_PlaneOrientationSequence), frame);
    readPosition(sequenceItem(groups, DCM_PlanePositionSequence), frame);
    readMeasures(sequenceItem(groups, DCM_PixelMeasuresSequence), frame);
    readRescale(sequenceItem(groups, DCM_PixelValueTransformationSequence), frame);
    readDimensions(sequenceItem(groups, DCM_FrameContentSequence), frame);
    readDimensions(sequenceItem(groups, DCM_MRDiffusionSequence), frame);
    readDimensions(sequenceItem(groups, DCM_TemporalPositionSequence), frame);
    for (const DcmTagKey &tag : {DCM_MRImageFrameTypeSequence, DCM_CTImageFrameTypeSequence})
        if (DcmItem *type = sequenceItem(groups, tag))
            if (std::string value = readText(type, DCM_FrameType); !value.empty())
                frame.imageType = value;
    if (DcmItem *segment = sequenceItem(groups, DCM_SegmentIdentificationSequence))
        frame.segment = std::clamp(readInteger(segment, DCM_ReferencedSegmentNumber), 0, 65535);
    if (DcmItem *echo = sequenceItem(groups, DCM_MREchoSequence))
        if (std::string value = readText(echo, DCM_EffectiveEchoTime); !value.empty())
            frame.dimensions["echo"] = value;
}

// The top-level attributes, which apply to all frames.
FrameHeader frameAtTop(DcmDataset &dataset) {
    FrameHeader frame;
    frame.imageType = readText(&dataset, DCM_ImageType);
    readOrientation(&dataset, frame);
    readPosition(&dataset, frame);
    readMeasures(&dataset, frame);
    readRescale(&dataset, frame);
    readDimensions(&dataset, frame);
    return frame;
}

void readMissingWindows(DcmItem *groups, const CharacterSets &sets, InstanceHeader &header) {
    if (!header.windows.empty())
        return;
    if (DcmItem *lut = sequenceItem(groups, DCM_FrameVOILUTSequence))
        header.windows = readWindows(*lut, sets);
}

// Each frame is a copy of `shared`, changed by its own groups.
void readPerFrame(DcmDataset &dataset, const CharacterSets &sets, const FrameHeader &shared,
                  int frames, InstanceHeader &header) {
    // Iterates, because access by index counts from the first item each time.
    DcmSequenceOfItems *perFrame = nullptr;
    dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, perFrame);
    DcmObject *item = perFrame != nullptr ? perFrame->nextInContainer(nullptr) : nullptr;
    for (int n = 0; n < frames; ++n) {
        FrameHeader frame = shared;
        if (auto *const groups = dynamic_cast<DcmItem *>(item)) {
            readFunctionalGroups(groups, frame);
            // The middle frame shows the subject of the study; the first and last may not.
            if (n == frames / 2)
                readMissingWindows(groups, sets, header);
            item = perFrame->nextInContainer(item);
        } else if (frames > 1) {
            // A multi-frame image without functional groups repeats one position, which is
            // meaningless.
            frame.positionMm.reset();
        }
        header.frames.push_back(std::move(frame));
    }
}

} // namespace

std::vector<volume::ValueWindow> readWindows(DcmItem &item, const CharacterSets &sets) {
    const auto centers = readNumbers(&item, DCM_WindowCenter),
               widths = readNumbers(&item, DCM_WindowWidth);
    std::vector<volume::ValueWindow> windows;
    for (std::size_t n = 0; n < std::min(centers.size(), widths.size()); ++n) {
        OFString name;
        item.findAndGetOFString(DCM_WindowCenterWidthExplanation, name, n);
        const volume::ValueWindow window{centers[n], widths[n],
                                         oneLine(sets.utf8(name.c_str(), false))};
        const bool known = std::any_of(windows.begin(), windows.end(), [&](const auto &w) {
            return w.center == window.center && w.width == window.width;
        });
        if (std::isfinite(window.center) && window.width >= 1e-6 && std::isfinite(window.width) &&
            !known)
            windows.push_back(window);
    }
    return windows;
}

void readFrames(DcmDataset &dataset, const CharacterSets &sets, std::size_t fileBytes,
                InstanceHeader &header) {
    FrameHeader shared = frameAtTop(dataset);
    DcmItem *const sharedGroups = sequenceItem(&dataset, DCM_SharedFunctionalGroupsSequence);
    if (sharedGroups != nullptr) {
        readFunctionalGroups(sharedGroups, shared);
        readMissingWindows(sharedGroups, sets, header);
    }
    const auto count = readNumber(&dataset, DCM_NumberOfFrames);
    const bool hasCount = count && *count >= 1.0;
    const double most = std::min(double(decoder::maxFrames), double(fileBytes));
    header.declaredFrames = hasCount ? int(std::min(*count, 2147483647.0)) : 1;
    readPerFrame(dataset, sets, shared, hasCount ? int(std::min(*count, most)) : 1, header);
    if (DcmItem *transform = sequenceItem(sharedGroups, DCM_PixelValueTransformationSequence);
        transform != nullptr && header.rescaleType.empty())
        header.rescaleType = readText(transform, DCM_RescaleType);
}

} // namespace pellucid::parse
