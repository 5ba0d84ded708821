// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/jpeg_xl.h"

#include <cmath>
#include <memory>
#include <new>

#include <jxl/decode.h>

#include "core/decoding/process/frame_check.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;

[[noreturn]] void fail(const task::Reason &why) {
    throw task::Error(task::ErrorCode::unusable, because::jpegXl(why));
}

struct Destroy {
    void operator()(JxlDecoder *decoder) const { JxlDecoderDestroy(decoder); }
};

} // namespace

JpegXlImage decodeJpegXl(std::span<const std::byte> data, const InstanceHeader &expected) {
    const std::unique_ptr<JxlDecoder, Destroy> decoder(JxlDecoderCreate(nullptr));
    if (!decoder)
        throw std::bad_alloc();
    const auto requireSuccess = [](JxlDecoderStatus status) {
        if (status != JXL_DEC_SUCCESS)
            fail(because::decoderCannotBeSetUp);
    };
    requireSuccess(
        JxlDecoderSubscribeEvents(decoder.get(), JXL_DEC_BASIC_INFO | JXL_DEC_FULL_IMAGE));
    // Rotation is left to the viewer, as for all other syntaxes.
    requireSuccess(JxlDecoderSetKeepOrientation(decoder.get(), JXL_TRUE));
    requireSuccess(JxlDecoderSetInput(
        decoder.get(), reinterpret_cast<const std::uint8_t *>(data.data()), data.size()));
    JxlDecoderCloseInput(decoder.get());
    const JxlPixelFormat format{1, JXL_TYPE_UINT16, JXL_NATIVE_ENDIAN, 0};
    JpegXlImage image;
    for (;;) {
        switch (JxlDecoderProcessInput(decoder.get())) {
        case JXL_DEC_BASIC_INFO: {
            // The sizes are checked before the decoder allocates memory.
            JxlBasicInfo info{};
            requireSuccess(JxlDecoderGetBasicInfo(decoder.get(), &info));
            requireMatchesHeader(info.ysize, info.xsize,
                                 int(info.num_color_channels + info.num_extra_channels),
                                 int(info.bits_per_sample), expected);
            if (info.have_animation == JXL_TRUE || info.bits_per_sample < 1 ||
                info.exponent_bits_per_sample != 0)
                fail(because::imageContradictsHeader);
            image.precision = int(info.bits_per_sample);
            break;
        }
        case JXL_DEC_NEED_IMAGE_OUT_BUFFER:
            image.samples.resize(std::size_t(expected.rows) * std::size_t(expected.columns));
            requireSuccess(
                JxlDecoderSetImageOutBuffer(decoder.get(), &format, image.samples.data(),
                                            image.samples.size() * sizeof(std::uint16_t)));
            break;
        case JXL_DEC_FULL_IMAGE:
            break;
        case JXL_DEC_SUCCESS: {
            if (image.samples.empty())
                fail(because::holdsNoImage);
            // The decoder returns integers scaled to 16 bits.
            const double top = std::exp2(image.precision) - 1.0;
            if (image.precision < 16)
                for (std::uint16_t &sample : image.samples)
                    sample = std::uint16_t(std::lround(sample * (top / 65535.0)));
            return image;
        }
        default:
            fail(because::damagedOrTruncated);
        }
    }
}

} // namespace pellucid::decoding::process
