// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/frame_headers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/decoding/client/dimensions.h"
#include "core/dicom_text/attributes.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

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
        position && glm::length(*position) <= farthestMm)
        frame.positionMm = position;
}

std::optional<glm::dvec2> spacingIn(DcmItem *item, const DcmTagKey &tag) {
    const auto spacing = readNumbers(item, tag, 2);
    if (spacing.size() != 2 || !(std::min(spacing[0], spacing[1]) >= smallestSpacingMm) ||
        !(std::max(spacing[0], spacing[1]) <= largestSpacingMm))
        return std::nullopt;
    return glm::dvec2(spacing[1], spacing[0]); // the attribute gives the distance of rows first
}

// The spacing of a projection, and where it holds (PS3.3, 10.7.1.3).
void readProjectedSpacing(DcmItem &dataset, FrameHeader &frame, InstanceHeader &header) {
    using volume::SpacingPlace;
    const auto detector = spacingIn(&dataset, DCM_ImagerPixelSpacing);
    const std::string calibration = readText(&dataset, DCM_PixelSpacingCalibrationType);
    if (frame.spacingMm) {
        const bool isDetector = detector && *detector == *frame.spacingMm;
        header.spacingPlace = calibration == "FIDUCIAL"   ? SpacingPlace::calibrated
                              : calibration == "GEOMETRY" ? SpacingPlace::geometry
                              : isDetector                ? SpacingPlace::detector
                                                          : SpacingPlace::patient;
    } else if (detector) {
        frame.spacingMm = detector;
        header.spacingPlace = SpacingPlace::detector;
        const auto factor = readNumber(&dataset, DCM_EstimatedRadiographicMagnificationFactor);
        constexpr double largest = 100.0;
        if (factor && *factor >= 1.0 && *factor <= largest) {
            *frame.spacingMm /= *factor;
            header.spacingPlace = SpacingPlace::magnified;
        }
    } else {
        frame.spacingMm = spacingIn(&dataset, DCM_NominalScannedPixelSpacing); // of a scanned film
        if (frame.spacingMm)
            header.spacingPlace = SpacingPlace::detector;
    }
}

void readMeasures(DcmItem *item, FrameHeader &frame) {
    if (const auto spacing = spacingIn(item, DCM_PixelSpacing))
        frame.spacingMm = spacing;
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
    Rescale &rescale = frame.rescale;
    const auto take = [&](const DcmTagKey &tag, double &into, bool &isReadable, bool &isStated) {
        if (readText(item, tag).empty()) // empty or missing
            return;
        isStated = true;
        const auto value = readNumber(item, tag);
        isReadable = value && std::abs(*value) <= largestRescale &&
                     (*value == 0.0 || std::abs(*value) >= smallestRescale) &&
                     !isMultiple(item, tag);
        if (isReadable)
            into = *value;
    };
    double slope = rescale.isSlopeZero ? 0.0 : rescale.slope;
    take(DCM_DoseGridScaling, slope, rescale.isSlopeReadable,
         rescale.isSlopeStated); // of a dose, in its units
    take(DCM_RescaleSlope, slope, rescale.isSlopeReadable, rescale.isSlopeStated);
    rescale.isSlopeZero = slope == 0.0;
    rescale.slope = rescale.isSlopeZero ? 1.0 : slope;
    take(DCM_RescaleIntercept, rescale.intercept, rescale.isInterceptReadable,
         rescale.isInterceptStated);
}

// Also those within sequences of one item, as in functional groups.
void readDimensions(DcmItem *item, int levels, FrameHeader &frame) {
    if (item == nullptr)
        return;
    for (DcmObject *object = item->nextInContainer(nullptr); object != nullptr;
         object = item->nextInContainer(object)) {
        const DcmTagKey tag = object->getTag();
        const std::uint32_t number = std::uint32_t(tag.getGroup()) << 16 | tag.getElement();
        auto *const sequence = dynamic_cast<DcmSequenceOfItems *>(object);
        if (levels > 0 && sequence != nullptr && object->ident() == EVR_SQ && sequence->card() == 1)
            readDimensions(sequence->getItem(0), levels - 1, frame);
        else if (std::any_of(dimensions.begin(), dimensions.end(),
                             [&](const auto &dimension) { return dimension.tag == number; }))
            if (std::string value = readText(item, tag); !value.empty())
                frame.dimensions[number] = std::move(value);
    }
}

void readFunctionalGroups(DcmItem *groups, FrameHeader &frame) {
    readOrientation(sequenceItem(groups, DCM_PlaneOrientationSequence), frame);
    readPosition(sequenceItem(groups, DCM_PlanePositionSequence), frame);
    readMeasures(sequenceItem(groups, DCM_PixelMeasuresSequence), frame);
    readRescale(sequenceItem(groups, DCM_PixelValueTransformationSequence), frame);
    readDimensions(groups, 2, frame);
    for (const DcmTagKey &tag : {DCM_MRImageFrameTypeSequence, DCM_CTImageFrameTypeSequence})
        if (DcmItem *type = sequenceItem(groups, tag))
            if (std::string value = readText(type, DCM_FrameType); !value.empty())
                frame.dimensions[imageTypeTag] = value;
    if (DcmItem *segment = sequenceItem(groups, DCM_SegmentIdentificationSequence))
        frame.segment = std::clamp(readInteger(segment, DCM_ReferencedSegmentNumber), 0, 65535);
}

// The top-level attributes, which apply to all frames.
FrameHeader frameAtTop(DcmDataset &dataset, InstanceHeader &header) {
    FrameHeader frame;
    // Nuclear medicine states the geometry of each detector.
    if (DcmItem *const detector = sequenceItem(&dataset, DCM_DetectorInformationSequence)) {
        readOrientation(detector, frame);
        readPosition(detector, frame);
    }
    readOrientation(&dataset, frame);
    readPosition(&dataset, frame);
    readMeasures(&dataset, frame);
    readProjectedSpacing(dataset, frame, header);
    readRescale(&dataset, frame);
    readDimensions(&dataset, 0, frame);
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

// The vectors of nuclear medicine have a value for each frame.
std::vector<double> vectorOf(DcmItem &dataset, const DcmTagKey &tag, std::size_t frames) {
    std::vector<double> values = readNumbers(&dataset, tag, frames + 1);
    if (values.size() != frames)
        values.clear();
    return values;
}

void readVectors(DcmItem &dataset, InstanceHeader &header) {
    for (const DcmTagKey &tag : {DCM_EnergyWindowVector, DCM_DetectorVector, DCM_PhaseVector,
                                 DCM_RRIntervalVector, DCM_TimeSlotVector, DCM_TimeSliceVector}) {
        const std::uint32_t number = std::uint32_t(tag.getGroup()) << 16 | tag.getElement();
        const auto values = vectorOf(dataset, tag, header.frames.size());
        for (std::size_t n = 0; n < header.frames.size(); ++n) {
            header.frames[n].dimensions.erase(number); // the whole vector
            if (!values.empty())
                header.frames[n].dimensions[number] = fmt::format("{:g}", values[n]);
        }
    }
}

// Where the frames of a file lie along the normal of the first, relative to it, mm; empty if they
// are no slices, or nothing says so.
std::vector<double> depthsOf(DcmItem &dataset, const FrameHeader &first, InstanceHeader &header) {
    const std::size_t count = header.frames.size();
    // Of a dose: relative to the first, or where the axis is that of the patient, absolute.
    std::vector<double> depths = vectorOf(dataset, DCM_GridFrameOffsetVector, count);
    if (!depths.empty()) {
        for (const double origin = depths.front(); double &depth : depths)
            depth -= origin;
        return depths;
    }
    const bool isNuclear = header.modality == "NM";
    const bool isInTime =
        dataset.tagExists(DCM_FrameTime) || dataset.tagExists(DCM_FrameTimeVector);
    if (isNuclear ? first.imageType().find("RECON") == std::string::npos : isInTime)
        return {};
    const auto spacing = readNumber(&dataset, DCM_SpacingBetweenSlices),
               thickness = readNumber(&dataset, DCM_SliceThickness);
    const bool hasSpacing = spacing && *spacing != 0.0;
    // A negative spacing runs against the normal of the slices.
    const double stepMm = hasSpacing ? *spacing : std::max(thickness.value_or(0.0), 0.0);
    if (!(std::abs(stepMm) >= smallestSpacingMm && std::abs(stepMm) <= largestSpacingMm))
        return {};
    if (!hasSpacing)
        header.oddities |= placedByThickness;
    else if (!isNuclear)
        header.oddities |= placedBySpacing;
    const auto slices = vectorOf(dataset, DCM_SliceVector, count);
    for (std::size_t n = 0; n < count; ++n)
        depths.push_back((slices.empty() ? double(n) : slices[n] - 1.0) * stepMm);
    return depths;
}

// Places the frames of a file that states one position for all of them: doses and reconstructed
// nuclear medicine, whose standards define it; and others, such as those of cone-beam scanners,
// whose frames are assumed to be slices.
void placeFrames(DcmItem &dataset, const FrameHeader &first, InstanceHeader &header) {
    if (!first.positionMm || !first.rowAxis || !first.columnAxis)
        return;
    const std::vector<double> depths = depthsOf(dataset, first, header);
    for (std::size_t n = 0; n < depths.size(); ++n) {
        const glm::dvec3 place =
            *first.positionMm + depths[n] * glm::cross(*first.rowAxis, *first.columnAxis);
        if (glm::length(place) <= farthestMm)
            header.frames[n].positionMm = place;
    }
}

volume::WindowFunction functionIn(DcmItem &item) {
    const std::string name = readText(&item, DCM_VOILUTFunction);
    return name == "SIGMOID"        ? volume::WindowFunction::sigmoid
           : name == "LINEAR_EXACT" ? volume::WindowFunction::linearExact
                                    : volume::WindowFunction::linear;
}

// The tables of an item as windows over the values that each maps.
std::vector<volume::ValueWindow> tablesIn(DcmItem &item, const CharacterSets &sets) {
    std::vector<volume::ValueWindow> windows;
    DcmSequenceOfItems *sequence = nullptr;
    if (item.findAndGetSequence(DCM_VOILUTSequence, sequence).bad())
        return windows;
    for (unsigned long n = 0; n < std::min(sequence->card(), 10UL); ++n) {
        DcmItem &table = *sequence->getItem(n);
        const auto descriptor = readNumbers(&table, DCM_LUTDescriptor, 3);
        const Uint16 *data = nullptr;
        unsigned long count = 0;
        if (descriptor.size() != 3 || !(descriptor[0] >= 0.0 && descriptor[0] <= 65535.0) ||
            !(std::abs(descriptor[1]) <= 65536.0) ||
            !(descriptor[2] >= 8.0 && descriptor[2] <= 16.0) ||
            table.findAndGetUint16Array(DCM_LUTData, data, &count).bad() || data == nullptr)
            continue;
        const auto entries =
            std::min<std::size_t>(descriptor[0] == 0.0 ? 65536 : std::size_t(descriptor[0]), count);
        if (entries < 2)
            continue;
        const double white = std::exp2(descriptor[2]) - 1.0, span = double(entries - 1);
        auto curve = std::make_shared<std::vector<float>>();
        for (std::size_t at = 0; at < entries; ++at)
            curve->push_back(float(std::min(1.0, data[at] / white)));
        windows.push_back({descriptor[1] + 0.5 * span, span,
                           readText(&table, DCM_LUTExplanation, &sets), false,
                           volume::WindowFunction::table, std::move(curve)});
    }
    return windows;
}

} // namespace

std::vector<volume::ValueWindow> readWindows(DcmItem &item, const CharacterSets &sets) {
    const auto centers = readNumbers(&item, DCM_WindowCenter),
               widths = readNumbers(&item, DCM_WindowWidth);
    std::vector<volume::ValueWindow> windows;
    for (std::size_t n = 0; n < std::min(centers.size(), widths.size()); ++n) {
        OFString name;
        item.findAndGetOFString(DCM_WindowCenterWidthExplanation, name, n);
        const volume::ValueWindow window{centers[n], widths[n], oneLine(sets.utf8(name.c_str())),
                                         false, functionIn(item)};
        const bool known = std::any_of(windows.begin(), windows.end(), [&](const auto &w) {
            return w.center == window.center && w.width == window.width;
        });
        if (std::isfinite(window.center) && window.width >= 1e-6 && std::isfinite(window.width) &&
            !known)
            windows.push_back(window);
    }
    // With both, either may be shown (PS3.3, C.11.2.1.1): the table is the more deliberate.
    std::vector<volume::ValueWindow> tables = tablesIn(item, sets);
    windows.insert(windows.begin(), tables.begin(), tables.end());
    return windows;
}

void readFrames(DcmDataset &dataset, const CharacterSets &sets, std::size_t fileBytes,
                InstanceHeader &header) {
    FrameHeader shared = frameAtTop(dataset, header);
    DcmItem *const sharedGroups = sequenceItem(&dataset, DCM_SharedFunctionalGroupsSequence);
    if (sharedGroups != nullptr) {
        readFunctionalGroups(sharedGroups, shared);
        readMissingWindows(sharedGroups, sets, header);
    }
    const auto count = readNumber(&dataset, DCM_NumberOfFrames);
    const bool hasCount = count && *count >= 1.0;
    const double most = std::min(double(maxFrames), double(fileBytes));
    header.declaredFrames = hasCount ? int(std::min(*count, 2147483647.0)) : 1;
    readPerFrame(dataset, sets, shared, hasCount ? int(std::min(*count, most)) : 1, header);
    readVectors(dataset, header);
    if (header.frames.size() > 1 && !dataset.tagExists(DCM_PerFrameFunctionalGroupsSequence))
        placeFrames(dataset, shared, header);
    if (DcmItem *transform = sequenceItem(sharedGroups, DCM_PixelValueTransformationSequence);
        transform != nullptr && header.rescaleType.empty())
        header.rescaleType = readText(transform, DCM_RescaleType);
}

} // namespace pellucid::decoding::process
