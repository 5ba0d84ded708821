// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/decode_jpeg2000.h"

#include <algorithm>
#include <cstring>

#include "core/dcmtk/handles_openjpeg.inc"
#include "core/decoding/process/frame_check.h"
#include "core/decoding/process/reasons.h"
#include "core/task/error.h"

namespace pellucid::decoding::process {

namespace {

namespace because = task::because;
using task::Error;
using task::ErrorCode;

using dcmtk::Codec;
using dcmtk::Image;
using dcmtk::Stream;

struct Source {
    std::span<const std::byte> data;
    std::size_t at = 0;
};

OPJ_SIZE_T readBytes(void *buffer, OPJ_SIZE_T count, void *user) {
    auto &source = *static_cast<Source *>(user);
    const std::size_t part = std::min<std::size_t>(count, source.data.size() - source.at);
    if (part == 0)
        return OPJ_SIZE_T(-1);
    std::memcpy(buffer, source.data.data() + source.at, part);
    source.at += part;
    return part;
}
OPJ_OFF_T skipBytes(OPJ_OFF_T count, void *user) {
    auto &source = *static_cast<Source *>(user);
    if (count < 0)
        return -1;
    const auto part = std::min<std::size_t>(std::size_t(count), source.data.size() - source.at);
    source.at += part;
    return OPJ_OFF_T(part);
}
OPJ_BOOL seekBytes(OPJ_OFF_T to, void *user) {
    auto &source = *static_cast<Source *>(user);
    if (to < 0 || std::size_t(to) > source.data.size())
        return OPJ_FALSE;
    source.at = std::size_t(to);
    return OPJ_TRUE;
}

// Finds the marker that ends a codestream. It may be followed by padding to an even length: zeros,
// or the bytes of erased memory. A codestream in a JP2 file may have boxes after it.
bool hasEnd(std::span<const std::byte> data) {
    while (!data.empty() && (data.back() == std::byte(0) || data.back() == std::byte(0xFF)))
        data = data.first(data.size() - 1);
    return data.size() > 1 && data.back() == std::byte(0xD9) &&
           data[data.size() - 2] == std::byte(0xFF);
}

} // namespace

dcmtk::Jpeg2000Image decodeJpeg2000(std::span<const std::byte> data,
                                    const InstanceHeader &expected) {
    const auto fail = [](const task::Reason &why) {
        throw Error(ErrorCode::unusable, because::jpeg2000(why));
    };
    if (data.size() < 12)
        fail(because::compressedDataTruncated);
    const bool codestream = data[0] == std::byte(0xFF) && data[1] == std::byte(0x4F);
    Source source{data};
    Stream stream(opj_stream_create(1 << 16, OPJ_TRUE));
    opj_stream_set_user_data(stream.get(), &source, nullptr);
    opj_stream_set_user_data_length(stream.get(), data.size());
    opj_stream_set_read_function(stream.get(), readBytes);
    opj_stream_set_skip_function(stream.get(), skipBytes);
    opj_stream_set_seek_function(stream.get(), seekBytes);
    const Codec codec(opj_create_decompress(codestream ? OPJ_CODEC_J2K : OPJ_CODEC_JP2));
    opj_dparameters_t parameters;
    opj_set_default_decoder_parameters(&parameters);
    if (opj_setup_decoder(codec.get(), &parameters) == OPJ_FALSE)
        fail(because::decoderCannotBeSetUp);
    opj_image_t *raw = nullptr;
    const OPJ_BOOL header = opj_read_header(stream.get(), codec.get(), &raw);
    const Image image(raw);
    if (header == OPJ_FALSE || !image || image->numcomps < 1)
        fail(because::damagedHeader);
    // The sizes are checked before the decoder allocates memory.
    requireMatchesHeader(std::int64_t(image->y1) - image->y0, std::int64_t(image->x1) - image->x0,
                         int(image->numcomps), int(image->comps[0].prec), expected);
    // The decoder also decodes damaged blocks and truncated streams.
    bool hasWarned = false;
    opj_set_warning_handler(
        codec.get(), [](const char *, void *warned) { *static_cast<bool *>(warned) = true; },
        &hasWarned);
    if (opj_decode(codec.get(), stream.get(), image.get()) == OPJ_FALSE ||
        image->comps[0].data == nullptr || image->comps[0].w != OPJ_UINT32(expected.columns) ||
        image->comps[0].h != OPJ_UINT32(expected.rows))
        fail(because::damagedOrTruncated);
    const opj_image_comp_t &component = image->comps[0];
    const std::size_t count = std::size_t(expected.rows) * std::size_t(expected.columns);
    return {expected.rows,
            expected.columns,
            int(component.prec),
            component.sgnd != 0,
            std::vector<std::int32_t>(component.data, component.data + count),
            hasWarned || (codestream && !hasEnd(data))};
}

} // namespace pellucid::decoding::process
