// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <utility>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <fmt/format.h>

#include "core/decoding/client/reasons.h"
#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/decode_jpeg2000.h"
#include "core/decoding/process/decode_pixels.h"
#include "core/decoding/process/decoder_warnings.h"
#include "core/decoding/process/fragments.h"
#include "core/decoding/process/frame_check.h"
#include "core/decoding/process/jpeg_xl.h"
#include "core/decoding/process/load_file.h"
#include "core/decoding/process/mosaic.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

[[noreturn]] void fail(const task::Reason &reason) {
    throw Error(ErrorCode::unusable, reason);
}

// Keeps the `bits` low bits and extends the sign to 16.
std::uint16_t extended(std::uint32_t value, int bits, bool isSigned) {
    const std::uint32_t mask = (1U << bits) - 1U;
    value &= mask;
    if (isSigned && (value >> (bits - 1)) != 0)
        value |= ~mask;
    return std::uint16_t(value);
}

// The header decides whether values are signed. If the codestream disagrees, its bits are the two's
// complement at its own precision.
template <class T>
void takeFrame(const std::vector<T> &samples, int precision, std::size_t frame,
               DecodedImage &image) {
    const InstanceHeader &h = image.header;
    const std::size_t plane = std::size_t(h.rows) * h.columns;
    for (std::size_t n = 0; n < plane; ++n)
        image.samples[frame * plane + n] =
            extended(std::uint32_t(samples[n]), precision, h.isSigned());
}

void decodeJpeg2000Frames(const CompressedFrames &frames, DecodedImage &image) {
    for (std::size_t n = 0; n < frames.count(); ++n) {
        const dcmtk::Jpeg2000Image decoded = decodeJpeg2000(frames.frame(n), image.header);
        image.header.hasDamagedPixels = image.header.hasDamagedPixels || decoded.isDamaged;
        takeFrame(decoded.samples, decoded.precision, n, image);
    }
}

void decodeJpegXlFrames(const CompressedFrames &frames, DecodedImage &image) {
    for (std::size_t n = 0; n < frames.count(); ++n) {
        const JpegXlImage decoded = decodeJpegXl(frames.frame(n), image.header);
        takeFrame(decoded.samples, decoded.precision, n, image);
    }
}

// Checks the frames, because DCMTK also decodes what does not match its header. Returns the largest
// precision of all frames.
int checkJpegFrames(const CompressedFrames &frames, const InstanceHeader &h,
                    const std::string &syntaxUid) {
    const auto syntax = DcmXfer(syntaxUid.c_str()).getXfer();
    // Markers that frames of the syntax may start with (ISO/IEC 10918-1, table B.1).
    const auto matchesSyntax = [&](int process) {
        switch (syntax) {
        case EXS_JPEGLSLossless:
        case EXS_JPEGLSLossy:
            return process == 0xF7;
        case EXS_JPEGProcess14:
        case EXS_JPEGProcess14SV1:
            return process == 0xC3;
        case EXS_JPEGProcess1:
            return process == 0xC0;
        default: // the decoder distinguishes extended and progressive
            return process >= 0xC0 && process <= 0xC2;
        }
    };
    int precision = 0;
    for (std::size_t n = 0; n < frames.count(); ++n) {
        const auto frame = jpegFrame(frames.frame(n));
        if (!frame)
            fail(because::frameHasNoHeader);
        requireMatchesHeader(frame->rows == 0 ? h.rows : frame->rows, frame->columns,
                             frame->components, frame->precision, h);
        if (!matchesSyntax(frame->process))
            fail(because::frameHasOtherCoding(fmt::format("FF{:02X}", frame->process),
                                              syntaxName(syntaxUid)));
        precision = std::max(precision, frame->precision);
    }
    return precision;
}

void checkRleFrames(const CompressedFrames &frames, const InstanceHeader &h) {
    for (std::size_t n = 0; n < frames.count(); ++n)
        if (const auto why =
                whyIncompleteRle(frames.frame(n), h.rows, h.columns, h.bitsAllocated / 8))
            fail(*why);
}

// Whether the decoder's words use more bits than the header's samples have. In a stream as wide as
// the words, the bits above may be 0, signed or not, as in plain samples.
bool exceedsStored(DcmDataset &dataset, const InstanceHeader &h, int precision) {
    if (h.bitsAllocated != 16)
        return false;
    const Uint16 *data = nullptr;
    unsigned long count = 0;
    dataset.findAndGetUint16Array(DCM_PixelData, data, &count);
    const bool isWide = precision == h.bitsAllocated;
    const int shift = precision > h.highBit ? h.highBit + 1 - h.bitsStored : 0;
    const std::uint32_t below = (1U << shift) - 1U;
    for (unsigned long n = 0; data != nullptr && n < count; ++n) {
        const std::uint32_t word = data[n], above = word >> (shift + h.bitsStored);
        if ((word & below) != 0 || (!(isWide && above == 0) &&
                                    extended(word >> shift, h.bitsStored, h.isSigned()) !=
                                        extended(word >> shift, precision - shift, h.isSigned())))
            return true;
    }
    return false;
}

// Decodes with DCMTK's codecs; the data set then holds the samples.
void decodeByDcmtk(const LoadedFile &file, const CompressedFrames &frames, std::size_t fileBytes,
                   InstanceHeader &h) {
    DcmDataset &dataset = file.dataset();
    const DcmXfer transfer(file.syntaxUid.c_str());
    const bool isRle = transfer.getXfer() == EXS_RLELossless;
    int precision = 0;
    if (isRle)
        checkRleFrames(frames, h);
    else
        precision = checkJpegFrames(frames, h, file.syntaxUid);
    const DecoderWarnings warnings;
    const OFCondition decoded = dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
    if (decoded.bad())
        fail(because::at(transfer.getXferName(), decoded.text()));
    h.hasDamagedPixels = warnings.foundDamage();
    // The decoder may have widened or narrowed the samples.
    const InstanceHeader after = headerOf(dataset, fileBytes);
    h.bitsAllocated = after.bitsAllocated;
    h.bitsStored = after.bitsStored;
    h.highBit = after.highBit;
    h.pixelRepresentation = after.pixelRepresentation;
    if (after.rows != h.rows || after.columns != h.columns || after.samplesPerPixel != 1 ||
        whyUndecodable(h))
        fail(because::compressedImageContradictsHeader);
    if (precision > h.bitsStored && exceedsStored(dataset, h, precision)) {
        h.oddities |= otherPrecision;
        // A stream as wide as the words does not tell their bits: its samples are masked like plain
        // ones.
        if (precision < h.bitsAllocated) {
            h.bitsStored = precision;
            h.highBit = precision - 1;
        }
    } else if (!isRle && precision <= h.highBit) {
        // The codestream has fewer bits than the header's high bit: its samples fill the low bits.
        h.highBit = h.bitsStored - 1;
    }
}

template <class T> std::span<const T> plainPixels(DcmDataset &dataset, std::size_t needed);
template <> std::span<const Uint16> plainPixels(DcmDataset &dataset, std::size_t needed) {
    const Uint16 *data = nullptr;
    unsigned long count = 0;
    dataset.findAndGetUint16Array(DCM_PixelData, data, &count);
    if (data == nullptr || count < needed)
        fail(because::pixelsTruncatedTo(data == nullptr ? 0 : count, needed));
    return {data, count};
}
template <> std::span<const Uint8> plainPixels(DcmDataset &dataset, std::size_t needed) {
    const Uint8 *data = nullptr;
    unsigned long count = 0;
    dataset.findAndGetUint8Array(DCM_PixelData, data, &count);
    if (data != nullptr && count >= needed)
        return {data, count};
    // Bytes stored as words (OW): the first in the low byte.
    const auto words = plainPixels<Uint16>(dataset, (needed + 1) / 2);
    return {reinterpret_cast<const Uint8 *>(words.data()), 2 * words.size()};
}

// Masks, eight samples to a byte, the first in the lowest bit. Frames follow without a gap.
void decodeBits(DcmDataset &dataset, DecodedImage &image) {
    const auto bytes = plainPixels<Uint8>(dataset, (image.samples.size() + 7) / 8);
    for (std::size_t n = 0; n < image.samples.size(); ++n)
        image.samples[n] = bytes[n / 8] >> (n % 8) & 1U;
    image.header.bitsAllocated = 8;
}

// Of 32 bits, the 16 that the values need, with a rescale that makes up for it.
void decodeLongSamples(DcmDataset &dataset, DecodedImage &image) {
    InstanceHeader &h = image.header;
    if (!h.modalityTable.empty())
        fail(because::hasUnsupportedBits(h.bitsAllocated));
    const auto words = plainPixels<Uint16>(dataset, 2 * image.samples.size());
    const int below = h.highBit + 1 - h.bitsStored, above = 64 - h.bitsStored;
    const auto stored = [&](std::size_t n) {
        const std::uint64_t code = words[2 * n] | std::uint64_t(words[2 * n + 1]) << 16;
        const std::uint64_t top = code >> below << above;
        return h.isSigned() ? std::int64_t(top) >> above : std::int64_t(top >> above);
    };
    std::int64_t least = stored(0), most = least;
    for (std::size_t n = 1; n < image.samples.size(); ++n) {
        least = std::min(least, stored(n));
        most = std::max(most, stored(n));
    }
    int lost = 0;
    while ((most - least) >> lost > 65535)
        ++lost;
    for (std::size_t n = 0; n < image.samples.size(); ++n)
        image.samples[n] = std::uint16_t((stored(n) - least) >> lost);
    h.bitsAllocated = h.bitsStored = 16;
    h.highBit = 15;
    h.pixelRepresentation = 0;
    const auto moved = [&](std::optional<int> &value) {
        if (value && *value >= least && *value <= most)
            *value = int((*value - least) >> lost);
        else
            value.reset();
    };
    moved(h.paddingValue);
    moved(h.paddingLimit);
    for (FrameHeader &frame : h.frames) {
        frame.rescale.intercept += frame.rescale.slope * double(least);
        frame.rescale.slope *= std::exp2(lost);
        if (std::max(std::abs(frame.rescale.intercept), std::abs(frame.rescale.slope)) >
            largestRescale)
            fail(because::rescaleGivesNoValues);
    }
}

void decodePlainFrames(DcmDataset &dataset, DecodedImage &image) {
    InstanceHeader &h = image.header;
    if (h.bitsAllocated == 1) {
        decodeBits(dataset, image);
        return;
    }
    if (h.bitsAllocated == 32) {
        decodeLongSamples(dataset, image);
        return;
    }
    const int shift = h.highBit + 1 - h.bitsStored;
    const auto take = [&](const auto &data) {
        for (std::size_t n = 0; n < image.samples.size(); ++n)
            image.samples[n] =
                extended(std::uint32_t(data[n]) >> shift, h.bitsStored, h.isSigned());
    };
    if (h.bitsAllocated == 8)
        take(plainPixels<Uint8>(dataset, image.samples.size()));
    else
        take(plainPixels<Uint16>(dataset, image.samples.size()));
}

// Compressed pixels with a defined length start like a compressed frame; otherwise they are plain.
bool isPlain(const LoadedFile &file, const InstanceHeader &h) {
    if (isNative(file.syntaxUid))
        return true;
    if ((h.oddities & definedLengthPixels) == 0)
        return false;
    DcmElement *element = nullptr;
    Uint8 *data = nullptr;
    if (file.dataset().findAndGetElement(DCM_PixelData, element).bad() ||
        element->getUint8Array(data).bad() || data == nullptr)
        fail(because::pixelsNotReadable);
    return !beginsCodestream({reinterpret_cast<const std::byte *>(data), element->getLength()});
}

// No codec in use packs more samples into a byte, not even of an empty image. A file that declares
// more is refused before memory is allocated.
void requireRoom(std::size_t samples, bool isPlainAndWhole, std::size_t fileBytes) {
    constexpr std::size_t maxSamplesPerByte = 20000;
    if (samples / (isPlainAndWhole ? 1 : maxSamplesPerByte) > fileBytes)
        fail(because::pixelsTruncated);
}

void decodeFrames(const LoadedFile &file, std::size_t fileBytes, DecodedImage &image) {
    const InstanceHeader &h = image.header;
    DcmDataset &dataset = file.dataset();
    if (!isPlain(file, h)) {
        if (h.bitsAllocated != 8 && h.bitsAllocated != 16)
            fail(because::hasUnsupportedBits(h.bitsAllocated));
        const CompressedFrames frames(dataset, h.frames.size(), beginsCodestream);
        if (isJpeg2000(file.syntaxUid)) {
            decodeJpeg2000Frames(frames, image);
            return;
        }
        if (isJpegXl(file.syntaxUid)) {
            decodeJpegXlFrames(frames, image);
            return;
        }
        if ((h.oddities & definedLengthPixels) != 0)
            fail(because::noFragments(syntaxName(file.syntaxUid)));
        decodeByDcmtk(file, frames, fileBytes, image.header);
    }
    decodePlainFrames(dataset, image);
}

DecodedImage decoded(std::span<const std::byte> bytes) {
    const LoadedFile file = loadFile(bytes, Extent::everything);
    const InstanceHeader header = headerOf(file, bytes.size());
    if (const auto reason = whyUnusable(header))
        fail(*reason);
    auto mosaic = mosaicOf(file.dataset(), header);
    DecodedImage image = decodePixels(file, bytes.size(), header);
    if (!mosaic) {
        mosaic = guessedMosaic(file.dataset(), header, image.samples);
        image.header.oddities |= mosaic ? decoding::guessedMosaic : 0U;
    }
    if (mosaic) {
        splitTiles(image.header, *mosaic);
        image.samples = tilesOf(image.samples, *mosaic, image.header.rows, image.header.columns);
    }
    return image;
}

} // namespace

void requireWholePixels(const LoadedFile &file, const InstanceHeader &h) {
    DcmElement *pixels = nullptr;
    if (!file.isComplete && file.dataset().findAndGetElement(DCM_PixelData, pixels).good() &&
        pixels->transferState() != ERW_ready && (h.oddities & missingDelimiter) == 0)
        fail(because::pixelsTruncated);
}

DecodedImage decodePixels(const LoadedFile &file, std::size_t fileBytes, InstanceHeader header) {
    requireWholePixels(file, header);
    DecodedImage image{std::move(header), {}};
    const InstanceHeader &h = image.header;
    const std::size_t samples =
        std::size_t(h.rows) * h.columns * h.frames.size(); // at most 2^32 * 10^5
    requireRoom(samples,
                isNative(file.syntaxUid) &&
                    file.syntaxUid != UID_DeflatedExplicitVRLittleEndianTransferSyntax &&
                    h.bitsAllocated != 1,
                fileBytes);
    image.samples.resize(samples);
    decodeFrames(file, fileBytes, image);
    return image;
}

DecodedImage decodeImage(std::span<const std::byte> bytes) {
    return orDamaged([&] { return decoded(bytes); });
}

} // namespace pellucid::decoding::process
