// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmiod/cielabutil.h>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/decode_pixels.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/dicom_text/attributes.h"
#include "core/task/error.h"

// DCMTK's own reader of segmentations, dcmseg, accepts no label maps and no segment numbers with
// gaps. The attributes are few, so that they are read here.

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

CodedConcept readCode(DcmItem *item, const DcmTagKey &sequence, const CharacterSets &sets) {
    DcmItem *const code = sequenceItem(item, sequence);
    CodedConcept read{readText(code, DCM_CodeValue), readText(code, DCM_CodingSchemeDesignator),
                      readText(code, DCM_CodeMeaning, &sets)};
    if (read.value.empty())
        read.value = readText(code, DCM_LongCodeValue);
    return read;
}

std::optional<glm::dvec3> readColor(DcmItem *item) {
    const auto lab = readNumbers(item, DCM_RecommendedDisplayCIELabValue, 3);
    if (lab.size() != 3 || *std::min_element(lab.begin(), lab.end()) < 0.0 ||
        *std::max_element(lab.begin(), lab.end()) > 65535.0)
        return std::nullopt;
    glm::dvec3 rgb{0.0};
    IODCIELabUtil::dicomLab2RGB(rgb.x, rgb.y, rgb.z, lab[0], lab[1], lab[2]);
    return glm::clamp(rgb, 0.0, 1.0);
}

// Label maps describe their background, too: segment 0 is none.
std::vector<SegmentDescription> readSegments(DcmDataset &dataset, const CharacterSets &sets) {
    std::vector<SegmentDescription> segments;
    std::set<int> numbers;
    DcmSequenceOfItems *sequence = nullptr;
    dataset.findAndGetSequence(DCM_SegmentSequence, sequence);
    DcmObject *object = sequence != nullptr ? sequence->nextInContainer(nullptr) : nullptr;
    for (; object != nullptr; object = sequence->nextInContainer(object)) {
        auto *const item = dynamic_cast<DcmItem *>(object);
        SegmentDescription segment;
        segment.number = readInteger(item, DCM_SegmentNumber, -1);
        if (segment.number == 0)
            continue;
        if (segment.number < 1 || segment.number > 65535)
            fail(because::segmentNumberOutOfRange);
        if (!numbers.insert(segment.number).second)
            fail(because::describesSegmentTwice(segment.number));
        if (segments.size() == maxSegments)
            fail(because::hasTooManySegments(maxSegments));
        segment.label = readText(item, DCM_SegmentLabel, &sets);
        segment.color = readColor(item);
        segment.category = readCode(item, DCM_SegmentedPropertyCategoryCodeSequence, sets);
        segment.type = readCode(item, DCM_SegmentedPropertyTypeCodeSequence, sets);
        segments.push_back(std::move(segment));
    }
    if (segments.empty())
        fail(because::hasNoSegments);
    return segments;
}

SegmentationKind readKind(DcmDataset &dataset) {
    const std::string type = readText(&dataset, DCM_SegmentationType);
    if (type == "BINARY")
        return SegmentationKind::binary;
    if (type == "FRACTIONAL")
        return SegmentationKind::fractional;
    if (type == "LABELMAP")
        return SegmentationKind::labelMap;
    fail(because::unknownSegmentationType(type));
}

void requirePlaces(const SegmentationHeader &header) {
    std::set<int> numbers;
    for (const SegmentDescription &segment : header.segments)
        numbers.insert(segment.number);
    for (const FrameHeader &frame : header.instance.frames) {
        if (!frame.positionMm || !frame.rowAxis || !frame.columnAxis || !frame.spacingMm)
            fail(because::frameHasNoPlace);
        if (header.kind != SegmentationKind::labelMap && !numbers.contains(frame.segment))
            fail(because::frameHasUnknownSegment(frame.segment));
    }
}

SegmentationHeader segmentationHeaderOf(const LoadedFile &file, std::size_t fileBytes) {
    SegmentationHeader header{headerOf(file, fileBytes), {}, 255, {}};
    InstanceHeader &h = header.instance;
    if (!isSegmentation(h))
        fail(because::isNoSegmentation);
    DcmDataset &dataset = file.dataset();
    const CharacterSets sets(dataset);
    header.kind = readKind(dataset);
    header.segments = readSegments(dataset, sets);
    if (header.kind == SegmentationKind::fractional)
        header.largestFraction = readInteger(&dataset, DCM_MaximumFractionalValue, 255);
    if (header.largestFraction < 1 || header.largestFraction > 65535)
        fail(because::fractionOutOfRange);
    // The colors of a palette belong to the numbers of segments.
    if (header.kind == SegmentationKind::labelMap && h.photometric == "PALETTE COLOR")
        h.photometric = "MONOCHROME2";
    if (h.declaredFrames != int(h.frames.size()))
        fail(because::announcesTooManyFrames(h.declaredFrames));
    requirePlaces(header);
    return header;
}

// Bits follow each other without a gap between rows and frames, the lowest of a byte first
// (PS3.5, section 8.1.1). As bytes or as words, this machine has them in the file's order.
std::span<const std::byte> packedBits(DcmDataset &dataset) {
    const Uint8 *bytes = nullptr;
    const Uint16 *words = nullptr;
    unsigned long count = 0;
    if (dataset.findAndGetUint8Array(DCM_PixelData, bytes, &count).good() && bytes != nullptr)
        return std::as_bytes(std::span(bytes, count));
    if (dataset.findAndGetUint16Array(DCM_PixelData, words, &count).good() && words != nullptr)
        return std::as_bytes(std::span(words, count));
    fail(because::pixelsNotReadable);
}

std::vector<std::byte> decodeBits(const LoadedFile &file, const InstanceHeader &h) {
    if (!isNative(file.syntaxUid))
        fail(because::maskIsCompressed);
    if (h.bitsAllocated != 1)
        fail(because::maskHasOtherBits(h.bitsAllocated, 1));
    if (h.rows < 1 || h.columns < 1)
        fail(because::hasAnImageWithoutSize);
    if (h.rows > 65535 || h.columns > 65535)
        fail(because::hasATooLargeImage);
    requireWholePixels(file, h);
    const std::size_t bits = std::size_t(h.rows) * std::size_t(h.columns) * h.frames.size();
    const auto stored = packedBits(file.dataset());
    if (stored.size() < (bits + 7) / 8)
        fail(because::pixelsTruncatedTo(8 * stored.size(), bits));
    const auto used = stored.first((bits + 7) / 8);
    return {used.begin(), used.end()};
}

DecodedSegmentation decoded(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::everything);
    DecodedSegmentation result{segmentationHeaderOf(file, bytes.size()), {}};
    const InstanceHeader &h = result.header.instance;
    if (result.header.kind == SegmentationKind::binary) {
        result.pixels = decodeBits(file, h);
        return result;
    }
    if (const auto reason = whyUndecodable(h))
        fail(*reason);
    if (h.isSigned())
        fail(because::doesNotSayWhetherSigned);
    const DecodedImage image = decodePixels(file, bytes.size(), h);
    const auto samples = std::as_bytes(std::span(image.samples));
    result.pixels.assign(samples.begin(), samples.end());
    return result;
}

} // namespace

DecodedSegmentation decodeSegmentation(std::span<const std::byte> bytes) {
    return orDamaged([&] { return decoded(bytes); });
}

} // namespace pellucid::decoding::process
