// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>

#include "core/parse/character_sets.h"
#include "core/parse/damage.h"
#include "core/parse/dataset.h"
#include "core/parse/mosaic.h"
#include "core/parse/parse.h"
#include "core/task/error.h"

namespace pellucid::parse {

namespace {

using task::Error;
using task::ErrorCode;

// Of any attribute that is read: a table of 65536 entries.
constexpr Uint32 longestValue = 2 * 65536;
constexpr std::size_t longestText = 1024; // bytes; DICOM's longest texts have 10240 letters

// Long values are shown nowhere, and a line is a line.
std::string oneLine(std::string text) {
    if (text.size() > longestText) {
        std::size_t end = longestText;
        while (end > 0 && (text[end] & 0xC0) == 0x80) // not within a letter
            --end;
        text.resize(end);
    }
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20 || c == 0x7F; },
        ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text;
}

// `sets`: of a text that may have letters beyond ASCII.
std::string text(DcmItem *item, const DcmTagKey &tag, const CharacterSets *sets = nullptr) {
    OFString value;
    if (item == nullptr || item->findAndGetOFStringArray(tag, value).bad())
        return {};
    const auto first = value.find_first_not_of(" \0");
    if (first == OFString_npos)
        return {};
    const std::string written(value.c_str() + first);
    return oneLine(sets != nullptr ? sets->utf8(written, tag == DCM_PatientName) : written);
}

// All of the text, or it is none: half of one, as of "2,5", is another number.
std::optional<double> numberIn(std::string_view text) {
    const auto isPadding = [](char c) { return c == ' ' || c == '\0'; };
    while (!text.empty() && isPadding(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isPadding(text.back()))
        text.remove_suffix(1);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber =
        error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    return isNumber ? std::optional(value) : std::nullopt;
}

std::vector<double> numbers(DcmItem *item, const DcmTagKey &tag, std::size_t most = 64) {
    // As text, whatever the type: DCMTK's typed getters each take one value representation only.
    std::vector<double> values;
    DcmElement *element = nullptr;
    if (item == nullptr || item->findAndGetElement(tag, element).bad())
        return values;
    OFString value;
    while (values.size() < most &&
           element->getOFString(value, static_cast<unsigned long>(values.size())).good()) {
        const auto parsed = numberIn({value.data(), value.size()});
        if (!parsed)
            break;
        values.push_back(*parsed);
    }
    return values;
}

std::optional<double> number(DcmItem *item, const DcmTagKey &tag) {
    const auto values = numbers(item, tag, 1);
    return values.empty() ? std::nullopt : std::optional(values[0]);
}

int integer(DcmItem *item, const DcmTagKey &tag, int otherwise = 0) {
    const auto value = number(item, tag);
    return value && std::abs(*value) < 2e9 ? int(*value) : otherwise;
}

DcmItem *sequenceItem(DcmItem *item, const DcmTagKey &tag, long index = 0) {
    DcmItem *found = nullptr;
    if (item == nullptr || item->findAndGetSequenceItem(tag, found, index).bad())
        return nullptr;
    return found;
}

std::optional<glm::dvec3> vector3(const std::vector<double> &v, std::size_t at) {
    if (v.size() < at + 3 || !std::isfinite(v[at] + v[at + 1] + v[at + 2]))
        return std::nullopt;
    return glm::dvec3(v[at], v[at + 1], v[at + 2]);
}

// Everything that can stand at the top of a file, in the shared groups, or in the groups of a
// frame.
void readOrientation(DcmItem *item, FrameHeader &frame) {
    const auto cosines = numbers(item, DCM_ImageOrientationPatient, 6);
    const auto row = vector3(cosines, 0), column = vector3(cosines, 3);
    // Both axes must be about unit length and about orthogonal, or the attribute is rubbish.
    if (row && column && std::abs(glm::length(*row) - 1.0) < 0.05 &&
        std::abs(glm::length(*column) - 1.0) < 0.05 && std::abs(glm::dot(*row, *column)) < 0.05) {
        frame.rowAxis = glm::normalize(*row);
        frame.columnAxis = glm::normalize(*column - glm::dot(*row, *column) * *row);
    }
}

void readPosition(DcmItem *item, FrameHeader &frame) {
    if (const auto position = vector3(numbers(item, DCM_ImagePositionPatient, 3), 0);
        position && glm::length(*position) <= decoder::farthestMm)
        frame.positionMm = position;
}

void readMeasures(DcmItem *item, FrameHeader &frame) {
    const auto spacing = numbers(item, DCM_PixelSpacing, 2);
    // The attribute gives the distance of rows first.
    if (spacing.size() == 2 && std::min(spacing[0], spacing[1]) >= decoder::smallestSpacingMm &&
        std::max(spacing[0], spacing[1]) <= decoder::largestSpacingMm)
        frame.spacingMm = glm::dvec2(spacing[1], spacing[0]);
    for (const DcmTagKey &tag : {DCM_SliceThickness, DCM_SpacingBetweenSlices})
        if (const auto mm = number(item, tag); mm && *mm > 0.0)
            frame.sliceThicknessMm = *mm;
}

// Below, values would all be the same.
constexpr double smallestRescale = 1e-30;

bool isMultiple(DcmItem *item, const DcmTagKey &tag) {
    DcmElement *element = nullptr;
    return item->findAndGetElement(tag, element).good() && element->getVM() > 1;
}

// What is there and cannot be used is remembered: without it the values would be others.
void readRescale(DcmItem *item, FrameHeader &frame) {
    decoder::Rescale &rescale = frame.rescale;
    const auto take = [&](const DcmTagKey &tag, double &into, bool &isReadable) {
        if (text(item, tag).empty()) // blanked, or not there
            return;
        const auto value = number(item, tag);
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
        {"b-value", DcmTagKey(0x0043, 0x1039)}, // GE's private place for it
        {"trigger time", DCM_TriggerTime},
        {"stack", DCM_StackID},
        {"acquisition time", DCM_AcquisitionTime},
        {"acquisition time", DCM_AcquisitionDateTime},
        {"content time", DCM_ContentTime},
    }};
    for (const auto &[name, tag] : tags)
        if (std::string value = text(item, tag); !value.empty())
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
            if (std::string value = text(type, DCM_FrameType); !value.empty())
                frame.imageType = value;
    if (DcmItem *echo = sequenceItem(groups, DCM_MREchoSequence))
        if (std::string value = text(echo, DCM_EffectiveEchoTime); !value.empty())
            frame.dimensions["echo"] = value;
}

std::vector<volume::ValueWindow> readWindows(DcmItem *item, const CharacterSets &sets) {
    const auto centers = numbers(item, DCM_WindowCenter), widths = numbers(item, DCM_WindowWidth);
    std::vector<volume::ValueWindow> windows;
    for (std::size_t n = 0; n < std::min(centers.size(), widths.size()); ++n) {
        OFString name;
        item->findAndGetOFString(DCM_WindowCenterWidthExplanation, name, n);
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

// Compressed ones say no size.
std::uint32_t pixelBytes(DcmDataset &dataset) {
    DcmElement *element = nullptr;
    if (dataset.findAndGetElement(DCM_PixelData, element).bad())
        return 0;
    const Uint32 bytes = element->getLengthField();
    return bytes == DCM_UndefinedLength ? 0 : bytes;
}

void readModalityTable(DcmItem &dataset, InstanceHeader &header) {
    DcmItem *item = sequenceItem(&dataset, DCM_ModalityLUTSequence);
    if (item == nullptr)
        return;
    const auto descriptor = numbers(item, DCM_LUTDescriptor, 3);
    const Uint16 *data = nullptr;
    unsigned long count = 0;
    if (descriptor.size() != 3 || !(descriptor[0] >= 0.0 && descriptor[0] <= 65536.0) ||
        !(std::abs(descriptor[1]) <= 65536.0) ||
        item->findAndGetUint16Array(DCM_LUTData, data, &count).bad() || data == nullptr)
        return;
    // The descriptor's first value 0 means 65536 entries; the second is signed as the pixels are.
    const std::size_t entries = descriptor[0] == 0.0 ? 65536 : std::size_t(descriptor[0]);
    header.modalityTable.assign(data, data + std::min<std::size_t>(entries, count));
    header.modalityTableFirst = int(descriptor[1]);
    if (header.isSigned() && header.modalityTableFirst > 32767)
        header.modalityTableFirst -= 65536;
}

} // namespace

void dropUnreadable(DcmItem &dataset) {
    // How the reading of an element ended is known to its class alone.
    struct Outcome : DcmObject {
        static OFCondition of(const DcmObject &object) { return object.*&Outcome::errorFlag; }
    };
    std::vector<std::pair<DcmItem *, DcmElement *>> unreadable;
    DcmStack stack;
    while (dataset.nextObject(stack, OFTrue).good()) {
        auto *const element = dynamic_cast<DcmElement *>(stack.top());
        auto *const parent = dynamic_cast<DcmItem *>(stack.elem(1));
        if (element == nullptr || parent == nullptr || !element->isLeaf())
            continue;
        const DcmTagKey tag = element->getTag();
        const bool isPixels =
            tag == DCM_PixelData || tag == DCM_FloatPixelData || tag == DCM_DoubleFloatPixelData;
        if (!isPixels && (Outcome::of(*element).bad() || element->getLengthField() > longestValue))
            unreadable.emplace_back(parent, element);
    }
    for (const auto &[parent, element] : unreadable)
        delete parent->remove(element);
}

InstanceHeader headerOf(DcmDataset &dataset, std::size_t fileBytes) {
    dropUnreadable(dataset);
    const CharacterSets sets(dataset);
    InstanceHeader h;
    h.sopClassUid = text(&dataset, DCM_SOPClassUID);
    h.sopInstanceUid = text(&dataset, DCM_SOPInstanceUID);
    const char *const name = dcmFindNameOfUID(h.sopClassUid.c_str());
    h.sopClassName = name != nullptr ? name : h.sopClassUid;
    h.patientId = text(&dataset, DCM_PatientID, &sets);
    h.patientName = text(&dataset, DCM_PatientName, &sets);
    h.birthDate = text(&dataset, DCM_PatientBirthDate);
    h.sex = text(&dataset, DCM_PatientSex);
    h.studyUid = text(&dataset, DCM_StudyInstanceUID);
    h.studyDate = text(&dataset, DCM_StudyDate);
    h.frameOfReferenceUid = text(&dataset, DCM_FrameOfReferenceUID);
    h.studyDescription = text(&dataset, DCM_StudyDescription, &sets);
    h.seriesUid = text(&dataset, DCM_SeriesInstanceUID);
    h.seriesDescription = text(&dataset, DCM_SeriesDescription, &sets);
    h.modality = text(&dataset, DCM_Modality);
    h.bodyPart = text(&dataset, DCM_BodyPartExamined);
    h.seriesNumber = integer(&dataset, DCM_SeriesNumber);
    h.instanceNumber = integer(&dataset, DCM_InstanceNumber);
    h.hasPixels = dataset.tagExists(DCM_PixelData) == OFTrue;
    h.floatPixels =
        dataset.tagExists(DCM_FloatPixelData) || dataset.tagExists(DCM_DoubleFloatPixelData);
    h.rows = integer(&dataset, DCM_Rows);
    h.columns = integer(&dataset, DCM_Columns);
    h.samplesPerPixel = integer(&dataset, DCM_SamplesPerPixel, 1);
    h.bitsAllocated = integer(&dataset, DCM_BitsAllocated);
    h.bitsStored = integer(&dataset, DCM_BitsStored, h.bitsAllocated);
    h.highBit = integer(&dataset, DCM_HighBit, h.bitsStored - 1);
    h.pixelRepresentation = integer(&dataset, DCM_PixelRepresentation, -1);
    h.lossy = text(&dataset, DCM_LossyImageCompression) == "01";
    h.photometric = text(&dataset, DCM_PhotometricInterpretation);
    h.rescaleType = text(&dataset, DCM_RescaleType);
    if (const auto value = number(&dataset, DCM_PixelPaddingValue))
        h.paddingValue = int(std::clamp(*value, -65536.0, 65536.0));
    if (const auto value = number(&dataset, DCM_PixelPaddingRangeLimit))
        h.paddingLimit = int(std::clamp(*value, -65536.0, 65536.0));
    h.windows = readWindows(&dataset, sets);
    h.pixelBytes = pixelBytes(dataset);
    readModalityTable(dataset, h);

    FrameHeader shared;
    shared.imageType = text(&dataset, DCM_ImageType);
    readOrientation(&dataset, shared);
    readPosition(&dataset, shared);
    readMeasures(&dataset, shared);
    readRescale(&dataset, shared);
    readDimensions(&dataset, shared);
    DcmItem *const sharedGroups = sequenceItem(&dataset, DCM_SharedFunctionalGroupsSequence);
    if (sharedGroups != nullptr) {
        readFunctionalGroups(sharedGroups, shared);
        if (h.windows.empty())
            if (DcmItem *lut = sequenceItem(sharedGroups, DCM_FrameVOILUTSequence))
                h.windows = readWindows(lut, sets);
    }
    const auto count = number(&dataset, DCM_NumberOfFrames);
    const double most = std::min(double(decoder::mostFrames), double(fileBytes));
    const int frames = count && *count >= 1.0 ? int(std::min(*count, most)) : 1;
    h.announcedFrames = count && *count >= 1.0 ? int(std::min(*count, 2147483647.0)) : 1;
    // From item to item: asked for by its number, each would be counted from the first.
    DcmSequenceOfItems *perFrame = nullptr;
    dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, perFrame);
    DcmObject *item = perFrame != nullptr ? perFrame->nextInContainer(nullptr) : nullptr;
    for (int n = 0; n < frames; ++n) {
        FrameHeader frame = shared;
        if (auto *const groups = dynamic_cast<DcmItem *>(item)) {
            readFunctionalGroups(groups, frame);
            // The middle one has what a study is about; of the ends that is not sure.
            if (n == frames / 2 && h.windows.empty())
                if (DcmItem *lut = sequenceItem(groups, DCM_FrameVOILUTSequence))
                    h.windows = readWindows(lut, sets);
            item = perFrame->nextInContainer(item);
        } else if (frames > 1) {
            // A multi-frame image without groups of its own repeats one position: it says nothing.
            frame.positionMm.reset();
        }
        h.frames.push_back(std::move(frame));
    }
    if (DcmItem *transform = sequenceItem(sharedGroups, DCM_PixelValueTransformationSequence);
        transform != nullptr && h.rescaleType.empty())
        h.rescaleType = text(transform, DCM_RescaleType);
    return h;
}

InstanceHeader headerOf(const LoadedFile &file, std::size_t fileBytes) {
    DcmDataset &dataset = file.dataset();
    InstanceHeader header = headerOf(dataset, fileBytes);
    header.oddities = file.oddities;
    header.transferSyntax = syntaxName(file.syntaxUid);
    if (!isDecodable(file.syntaxUid))
        header.unsupportedSyntax = header.transferSyntax;
    if (header.sopClassUid.empty())
        header.sopClassUid = text(file.format->getMetaInfo(), DCM_MediaStorageSOPClassUID);
    const bool isCompressed = !isNative(file.syntaxUid);
    if (isCompressed && header.pixelBytes > 0)
        header.oddities |= decoder::definedLengthPixels;
    else if (isCompressed && !file.isComplete)
        header.oddities |= decoder::missingDelimiter;
    if (isCompressed)
        header.pixelBytes = 0;
    return header;
}

namespace {

InstanceHeader parsed(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::header);
    DcmDataset &dataset = file.dataset();
    InstanceHeader header = headerOf(file, bytes.size());
    const bool isDeflated = file.syntaxUid == UID_DeflatedExplicitVRLittleEndianTransferSyntax;
    // Inflated up to the pixels only: whether there are any is seen when they are wanted.
    header.hasPixels =
        header.hasPixels || (isDeflated && header.rows > 0 && header.bitsAllocated > 0);
    // Plain pixels have a known size; a file that is shorter cannot hold them.
    const double needed = double(header.rows) * header.columns * header.samplesPerPixel *
                          header.bitsAllocated / 8.0 * double(header.frames.size());
    if (header.hasPixels && !isDeflated && !whyUnusable(header) && isNative(file.syntaxUid) &&
        needed > double(bytes.size()))
        throw Error(ErrorCode::unusable, task::because::pixelsTruncated);
    // What follows damaged elements is lost, but a complete image in front of them is not.
    if (!file.isComplete && !(header.hasPixels && header.rows > 0))
        throw Error(ErrorCode::unusable, task::because::isDamagedBy(file.failure));
    if (const auto mosaic = mosaicOf(dataset, header))
        takeApart(header, *mosaic);
    else if (isMosaic(header))
        header.oddities |= decoder::unreadMosaic;
    return header;
}

} // namespace

InstanceHeader parseHeader(std::span<const std::byte> bytes) {
    return orDamaged([&] { return parsed(bytes); });
}

} // namespace pellucid::parse
