// SPDX-License-Identifier: GPL-3.0-or-later
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include "core/decoding/process/damage.h"
#include "core/decoding/process/dataset.h"
#include "core/decoding/process/decode_pixels.h"
#include "core/decoding/process/load_file.h"
#include "core/decoding/process/parse.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

void require(const OFCondition &condition) {
    if (condition.bad())
        throw Error(ErrorCode::unusable, because::isDamagedBy(std::string(condition.text())));
}

// Replaces the fragments by the samples. Attributes of the pixels follow what was decoded.
void putSamples(DcmDataset &dataset, const DecodedImage &image) {
    const InstanceHeader &h = image.header;
    delete dataset.remove(DCM_PixelData);
    require(dataset.putAndInsertUint16(DCM_BitsAllocated, Uint16(h.bitsAllocated)));
    require(dataset.putAndInsertUint16(DCM_BitsStored, Uint16(h.bitsStored)));
    require(dataset.putAndInsertUint16(DCM_HighBit, Uint16(h.bitsStored - 1)));
    if (h.bitsAllocated == 8) {
        std::vector<Uint8> bytes(image.samples.begin(), image.samples.end());
        if (bytes.size() % 2 != 0) // DICOM requires an even length
            bytes.push_back(0);
        require(dataset.putAndInsertUint8Array(DCM_PixelData, bytes.data(),
                                               static_cast<unsigned long>(bytes.size())));
    } else {
        // Bits above the stored ones are cleared; in signed images, they repeat the sign.
        const std::uint16_t mask = std::uint16_t((1U << h.bitsStored) - 1U);
        std::vector<Uint16> words(image.samples.begin(), image.samples.end());
        if (!h.isSigned())
            for (Uint16 &word : words)
                word &= mask;
        require(dataset.putAndInsertUint16Array(DCM_PixelData, words.data(),
                                                static_cast<unsigned long>(words.size())));
    }
}

// Pictures in color are no slices, and only sent: their frames are not compared with the header as
// those of slices. DCMTK's codecs make RGB of them.
void decodeColors(DcmDataset &dataset, const InstanceHeader &h) {
    require(dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr));
    DcmElement *pixels = nullptr;
    require(dataset.findAndGetElement(DCM_PixelData, pixels));
    const double needed =
        double(h.rows) * h.columns * h.samplesPerPixel * h.declaredFrames * (h.bitsAllocated / 8.0);
    if (needed < 1.0 || double(pixels->getLength(EXS_LittleEndianExplicit)) < needed)
        throw Error(ErrorCode::unusable, because::compressedImageContradictsHeader);
}

std::vector<std::byte> written(DcmFileFormat &format, E_TransferSyntax syntax) {
    require(format.validateMetaInfo(syntax, EWM_createNewMeta));
    std::vector<std::byte> out;
    std::vector<std::byte> part(std::size_t(1) << 20);
    DcmOutputBufferStream stream(part.data(), offile_off_t(part.size()));
    format.transferInit();
    for (OFCondition state = EC_StreamNotifyClient; state == EC_StreamNotifyClient;) {
        state = format.write(stream, syntax, EET_UndefinedLength, nullptr, EGL_recalcGL,
                             EPD_withoutPadding);
        void *bytes = nullptr;
        offile_off_t count = 0;
        stream.flushBuffer(bytes, count);
        out.insert(out.end(), static_cast<const std::byte *>(bytes),
                   static_cast<const std::byte *>(bytes) + count);
        if (state != EC_StreamNotifyClient)
            require(state);
    }
    format.transferEnd();
    return out;
}

std::vector<std::byte> rewritten(std::span<const std::byte> bytes, const std::string &syntaxUid) {
    const E_TransferSyntax syntax = DcmXfer(syntaxUid.c_str()).getXfer();
    const LoadedFile file = loadFile(bytes, Extent::everything);
    DcmDataset &dataset = file.dataset();
    if (!isNative(file.syntaxUid)) {
        const InstanceHeader header = headerOf(file, bytes.size());
        // DCMTK's codecs put the samples into the data set, ours do not.
        const bool isByDcmtk = !isJpeg2000(file.syntaxUid) && !isJpegXl(file.syntaxUid);
        if (isByDcmtk && header.samplesPerPixel == 3) {
            decodeColors(dataset, header);
        } else {
            if (const auto reason = whyUnusable(header))
                throw Error(ErrorCode::unusable, *reason);
            const DecodedImage image = decodePixels(file, bytes.size(), header);
            if (!isByDcmtk)
                putSamples(dataset, image);
        }
    }
    require(dataset.chooseRepresentation(syntax, nullptr));
    return written(*file.format, syntax);
}

} // namespace

std::vector<std::byte> uncompress(std::span<const std::byte> file, const std::string &syntaxUid) {
    return orDamaged([&] { return rewritten(file, syntaxUid); });
}

} // namespace pellucid::decoding::process
