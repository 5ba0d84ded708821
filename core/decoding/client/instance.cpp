// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/client/instance.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/decoding/client/dimensions.h"
#include "core/decoding/client/reasons.h"
#include "core/decoding/client/segmentation_file.h"

namespace pellucid::decoding {

namespace {

namespace because = task::because;

// Media Storage Directory Storage; Segmentation, Label Map Segmentation and RT Structure Set
// Storage (PS3.4, B.5).
constexpr const char *directoryClass = "1.2.840.10008.1.3.10";
constexpr const char *segmentationClass = "1.2.840.10008.5.1.4.1.1.66.4",
                     *labelMapClass = "1.2.840.10008.5.1.4.1.1.66.7",
                     *structureSetClass = "1.2.840.10008.5.1.4.1.1.481.3";

} // namespace

std::string FrameHeader::imageType() const {
    const auto at = dimensions.find(imageTypeTag);
    return at == dimensions.end() ? std::string() : at->second;
}

bool isSegmentation(const InstanceHeader &h) {
    return h.sopClassUid == segmentationClass || h.sopClassUid == labelMapClass;
}

bool isStructureSet(const InstanceHeader &h) {
    return h.sopClassUid == structureSetClass;
}

std::uint64_t pointCount(const StructureSetHeader &header) {
    std::uint64_t points = 0;
    for (const Structure &structure : header.structures)
        points =
            std::accumulate(structure.contourSizes.begin(), structure.contourSizes.end(), points);
    return points;
}

std::optional<task::Reason> whyUnusable(const InstanceHeader &h) {
    if (h.sopClassUid == directoryClass)
        return because::isAnIndex;
    if (isSegmentation(h) || isStructureSet(h))
        return because::isASegmentation;
    return whyUndecodable(h);
}

std::optional<task::Reason> whyUndecodable(const InstanceHeader &h) {
    if (h.floatPixels)
        return because::hasFloatingPointPixels;
    if (!h.hasPixels)
        return h.sopClassName.empty() ? task::Reason(because::hasNoPixels)
                                      : because::hasNoPixelsBut(h.sopClassName);
    if (h.rows < 1 || h.columns < 1)
        return because::hasAnImageWithoutSize;
    if (h.rows > 65535 || h.columns > 65535)
        return because::hasATooLargeImage;
    if (h.declaredFrames != int(h.frames.size()))
        return because::announcesTooManyFrames(h.declaredFrames);
    const bool isMonochrome =
        h.photometric == "MONOCHROME1" || h.photometric == "MONOCHROME2" || h.photometric.empty();
    if (!isMonochrome)
        return because::isAColorImage(h.photometric);
    if (h.samplesPerPixel != 1)
        return because::hasSeveralSamples(h.samplesPerPixel);
    if (!h.unsupportedSyntax.empty())
        return because::unsupportedSyntax(h.unsupportedSyntax);
    constexpr std::array bits{1, 8, 16, 32};
    if (std::find(bits.begin(), bits.end(), h.bitsAllocated) == bits.end())
        return because::hasUnsupportedBits(h.bitsAllocated);
    if (h.bitsStored < 1 || h.bitsStored > h.bitsAllocated || h.highBit >= h.bitsAllocated ||
        h.highBit + 1 < h.bitsStored)
        return because::storesImplausibleBits(h.bitsStored, h.bitsAllocated, h.highBit);
    if (h.pixelRepresentation != 0 && h.pixelRepresentation != 1)
        return because::doesNotSayWhetherSigned;
    for (const FrameHeader &frame : h.frames)
        if (h.modalityTable.empty() &&
            !(frame.rescale.isSlopeReadable && frame.rescale.isInterceptReadable))
            return because::rescaleGivesNoValues;
    return std::nullopt;
}

bool isHuge(const InstanceHeader &h, std::uint64_t fileBytes) {
    constexpr double hugeBytes = 512e6, hugeFactor = 1000.0;
    constexpr int largestSide = 16384;
    const int side = std::max(1, h.mosaicSide);
    const double pixels = 2.0 * h.rows * h.columns * double(h.frames.size());
    return std::max(h.rows, h.columns) * side > largestSide ||
           (pixels > hugeBytes && pixels > hugeFactor * double(fileBytes));
}

bool hasSurplusPixels(const InstanceHeader &h) {
    const double tiles = h.mosaicSide > 0 ? double(h.mosaicSide) * h.mosaicSide : h.declaredFrames;
    const double described =
        double(h.rows) * h.columns * h.samplesPerPixel * h.bitsAllocated / 8.0 * tiles;
    return double(h.pixelBytes) > described + 1.0;
}

} // namespace pellucid::decoding
