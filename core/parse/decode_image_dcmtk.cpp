// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <fmt/format.h>

#include "core/parse/damage.h"
#include "core/parse/dataset.h"
#include "core/parse/decoder_warnings.h"
#include "core/parse/dictionary.h"
#include "core/parse/jpeg2000.h"
#include "core/parse/memory_input.h"
#include "core/parse/parse.h"
#include "core/task/error.h"

namespace pellucid::parse {

namespace {

using task::Error;
using task::ErrorCode;

[[noreturn]] void fail(const std::string &reason) {
    throw Error(ErrorCode::unusable, reason);
}

// Keeps `bits` low bits and spreads the sign over 16.
std::uint16_t extended(std::uint32_t value, int bits, bool isSigned) {
    const std::uint32_t mask = (1U << bits) - 1U;
    value &= mask;
    if (isSigned && (value >> (bits - 1)) != 0)
        value |= ~mask;
    return std::uint16_t(value);
}

bool isJpeg2000(E_TransferSyntax syntax) {
    return syntax == EXS_JPEG2000LosslessOnly || syntax == EXS_JPEG2000;
}

std::vector<std::byte> bytesOf(DcmPixelSequence &sequence, unsigned long first, unsigned long end) {
    std::vector<std::byte> bytes;
    for (unsigned long n = first; n < end; ++n) {
        DcmPixelItem *item = nullptr;
        Uint8 *data = nullptr;
        if (sequence.getItem(item, n).bad() || item->getUint8Array(data).bad() ||
            (data == nullptr && item->getLength() > 0))
            fail("a fragment of the compressed pixels is not readable");
        const auto *from = reinterpret_cast<const std::byte *>(data);
        bytes.insert(bytes.end(), from, from + item->getLength());
    }
    return bytes;
}

bool startsCodestream(DcmPixelSequence &sequence, unsigned long fragment) {
    DcmPixelItem *item = nullptr;
    Uint8 *data = nullptr;
    if (sequence.getItem(item, fragment).bad())
        fail("a fragment of the compressed pixels is not readable");
    if (item->getLength() < 12)
        return false;
    if (item->getUint8Array(data).bad() || data == nullptr)
        fail("a fragment of the compressed pixels is not readable");
    return (data[0] == 0xFF && data[1] == 0x4F) || std::memcmp(data + 4, "jP  ", 4) == 0;
}

void decodeJpeg2000Frames(DcmDataset &dataset, DecodedImage &image) {
    const InstanceHeader &h = image.header;
    DcmElement *element = nullptr;
    dataset.findAndGetElement(DCM_PixelData, element);
    auto *pixels = dynamic_cast<DcmPixelData *>(element);
    DcmPixelSequence *sequence = nullptr;
    E_TransferSyntax syntax = EXS_Unknown;
    const DcmRepresentationParameter *parameter = nullptr;
    if (pixels != nullptr)
        pixels->getOriginalRepresentationKey(syntax, parameter);
    if (pixels == nullptr ||
        pixels->getEncapsulatedRepresentation(syntax, parameter, sequence).bad() ||
        sequence == nullptr)
        fail("the compressed pixels are not readable");
    // Fragment 0 is the offset table. A frame may be cut into several fragments; each starts where
    // a codestream starts.
    std::vector<unsigned long> starts;
    const unsigned long fragments = sequence->card();
    for (unsigned long n = 1; n < fragments; ++n)
        // The fragments of one frame belong together, whatever they start with.
        if (h.frames.size() == 1 ? n == 1 : startsCodestream(*sequence, n))
            starts.push_back(n);
    if (starts.size() != h.frames.size())
        fail(fmt::format("holds {} compressed frames, {} are announced", starts.size(),
                         h.frames.size()));
    starts.push_back(fragments);
    const std::size_t plane = std::size_t(h.rows) * h.columns;
    for (std::size_t frame = 0; frame + 1 < starts.size(); ++frame) {
        const auto bytes = bytesOf(*sequence, starts[frame], starts[frame + 1]);
        const Jpeg2000Image decoded = decodeJpeg2000(bytes, h.rows, h.columns);
        image.header.hasDamagedPixels = image.header.hasDamagedPixels || decoded.isDamaged;
        // The header decides whether values are signed; where the codestream disagrees its bits are
        // the two's complement of its own precision.
        for (std::size_t n = 0; n < plane; ++n)
            image.samples[frame * plane + n] =
                extended(std::uint32_t(decoded.samples[n]), decoded.precision, h.isSigned());
    }
}

void decodePlainFrames(DcmDataset &dataset, DecodedImage &image) {
    InstanceHeader &h = image.header;
    const std::size_t needed = image.samples.size();
    unsigned long count = 0;
    const int shift = h.highBit + 1 - h.bitsStored;
    const auto take = [&](const auto *data) {
        if (data == nullptr || count < needed)
            fail(fmt::format("the pixels are truncated: {} of {} samples",
                             data == nullptr ? 0 : count, needed));
        for (std::size_t n = 0; n < needed; ++n)
            image.samples[n] =
                extended(std::uint32_t(data[n]) >> shift, h.bitsStored, h.isSigned());
    };
    if (h.bitsAllocated == 8) {
        const Uint8 *data = nullptr;
        dataset.findAndGetUint8Array(DCM_PixelData, data, &count);
        if (data != nullptr) {
            take(data);
            return;
        }
        // 8 bits stored as words (OW): two samples a word, the first in the low byte.
        const Uint16 *words = nullptr;
        dataset.findAndGetUint16Array(DCM_PixelData, words, &count);
        count *= 2;
        if (words == nullptr || count < needed)
            fail("the pixels are truncated");
        for (std::size_t n = 0; n < needed; ++n)
            image.samples[n] = extended(std::uint32_t(words[n / 2] >> (n % 2 * 8)) >> shift,
                                        h.bitsStored, h.isSigned());
        return;
    }
    const Uint16 *data = nullptr;
    dataset.findAndGetUint16Array(DCM_PixelData, data, &count);
    take(data);
}

DecodedImage decoded(std::span<const std::byte> bytes) {
    prepareDcmtk();

    const auto input = memoryInput(bytes);
    DcmFileFormat file;
    file.transferInit();
    const OFCondition parsed = file.read(*input, EXS_Unknown, EGL_noChange);
    file.transferEnd();
    DcmDataset *dataset = file.getDataset();
    if (dataset == nullptr || dataset->card() == 0)
        fail("is not a DICOM file");
    DecodedImage image{headerOf(*dataset, bytes.size()), {}};
    if (const auto reason = whyUnusable(image.header))
        fail(*reason);
    // DCMTK keeps what it has of an element that the file does not finish, and fills the rest.
    DcmElement *pixels = nullptr;
    if (parsed.bad() && dataset->findAndGetElement(DCM_PixelData, pixels).good() &&
        pixels->transferState() != ERW_ready)
        fail("the pixels are truncated");
    const E_TransferSyntax syntax = dataset->getOriginalXfer();
    const DcmXfer transfer(syntax);
    const std::size_t plane = std::size_t(image.header.rows) * image.header.columns;
    const std::size_t announced = plane * image.header.frames.size(); // at most 2^32 * 10^5
    const bool plain = !transfer.isEncapsulated() && syntax != EXS_DeflatedLittleEndianExplicit;
    // No coder in use packs more samples into a byte, not even of an empty image; what
    // announces more is refused before memory is asked for.
    constexpr std::size_t mostSamplesPerByte = 20000;
    if (announced / (plain ? 1 : mostSamplesPerByte) > bytes.size())
        fail("the pixels are truncated");
    image.samples.resize(plane * image.header.frames.size());
    if (isJpeg2000(syntax)) {
        decodeJpeg2000Frames(*dataset, image);
        return image;
    }
    if (transfer.isEncapsulated()) {
        const DecoderWarnings warnings;
        const OFCondition decoded =
            dataset->chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
        if (decoded.bad())
            fail(fmt::format("{}: {}", transfer.getXferName(), decoded.text()));
        image.header.hasDamagedPixels = warnings.sayDamaged();
        // The decoder may have widened or narrowed the samples.
        const InstanceHeader after = headerOf(*dataset, bytes.size());
        image.header.bitsAllocated = after.bitsAllocated;
        image.header.bitsStored = after.bitsStored;
        image.header.highBit = after.highBit;
        image.header.pixelRepresentation = after.pixelRepresentation;
        if (after.rows != image.header.rows || after.columns != image.header.columns ||
            after.samplesPerPixel != 1 || whyUnusable(image.header))
            fail("the compressed image is not what the header says");
    }
    decodePlainFrames(*dataset, image);
    return image;
}

} // namespace

DecodedImage decodeImage(std::span<const std::byte> bytes) {
    return orDamaged([&] { return decoded(bytes); });
}

} // namespace pellucid::parse
