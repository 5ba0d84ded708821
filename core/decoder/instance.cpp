// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoder/instance.h"

#include <algorithm>

#include <fmt/format.h>

namespace pellucid::decoder {

namespace {

// Media Storage Directory Storage; Segmentation and Label Map
// Segmentation Storage (PS3.4, B.5).
constexpr const char *directoryClass = "1.2.840.10008.1.3.10";
constexpr const char *segmentationClass = "1.2.840.10008.5.1.4.1.1.66.4",
                     *labelMapClass = "1.2.840.10008.5.1.4.1.1.66.7";

} // namespace

std::optional<std::string> whyUnusable(const InstanceHeader &h) {
    if (h.sopClassUid == directoryClass)
        return "is an index of files, not an image";
    if (h.sopClassUid == segmentationClass || h.sopClassUid == labelMapClass)
        return "segmentations are not shown";
    if (h.floatPixels)
        return "floating-point pixels are not supported";
    if (!h.hasPixels)
        return h.sopClassName.empty() ? std::string("has no pixels")
                                      : "has no pixels (" + h.sopClassName + ")";
    if (h.rows < 1 || h.columns < 1)
        return "has an image without size";
    if (h.rows > 65535 || h.columns > 65535)
        return "has an image larger than DICOM allows";
    if (h.announcedFrames != int(h.frames.size()))
        return fmt::format("announces {} frames, more than the file can hold", h.announcedFrames);
    const bool isMonochrome =
        h.photometric == "MONOCHROME1" || h.photometric == "MONOCHROME2" || h.photometric.empty();
    if (!isMonochrome)
        return "is a colour image (" + h.photometric + ")";
    if (h.samplesPerPixel != 1)
        return fmt::format("has {} samples per pixel; monochrome images have one",
                           h.samplesPerPixel);
    if (!h.unsupportedSyntax.empty())
        return "transfer syntax not supported: " + h.unsupportedSyntax;
    if (h.bitsAllocated != 8 && h.bitsAllocated != 16)
        return fmt::format("has {} bits per sample; 8 and 16 are supported", h.bitsAllocated);
    if (h.bitsStored < 1 || h.bitsStored > h.bitsAllocated || h.highBit >= h.bitsAllocated ||
        h.highBit + 1 < h.bitsStored)
        return fmt::format("says that {} of {} bits are stored up to bit {}", h.bitsStored,
                           h.bitsAllocated, h.highBit);
    if (h.pixelRepresentation != 0 && h.pixelRepresentation != 1)
        return "does not say whether its values are signed";
    for (const FrameHeader &frame : h.frames)
        if (h.modalityTable.empty() &&
            !(frame.rescale.isSlopeReadable && frame.rescale.isInterceptReadable))
            return "has a rescale slope or intercept that gives no values";
    return std::nullopt;
}

bool isHuge(const InstanceHeader &h, std::uint64_t fileBytes) {
    constexpr double manyBytes = 512e6, manyTimes = 1000.0;
    constexpr int largestSide = 16384;
    const int side = std::max(1, h.mosaicSide);
    const double pixels = 2.0 * h.rows * h.columns * double(h.frames.size());
    return std::max(h.rows, h.columns) * side > largestSide ||
           (pixels > manyBytes && pixels > manyTimes * double(fileBytes));
}

bool hasSurplusPixels(const InstanceHeader &h) {
    const double tiles = h.mosaicSide > 0 ? double(h.mosaicSide) * h.mosaicSide : h.announcedFrames;
    const double described =
        double(h.rows) * h.columns * h.samplesPerPixel * h.bitsAllocated / 8.0 * tiles;
    return double(h.pixelBytes) > described + 1.0;
}

} // namespace pellucid::decoder
