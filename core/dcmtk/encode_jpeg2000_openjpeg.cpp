// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dcmtk/encode_jpeg2000.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "core/dcmtk/handles_openjpeg.inc"
#include "core/dcmtk/reasons.h"
#include "core/task/error.h"

namespace pellucid::dcmtk {

namespace {

using task::Error;
using task::ErrorCode;

struct Sink {
    std::vector<std::byte> data;
    std::size_t at = 0;
};

OPJ_SIZE_T writeBytes(void *buffer, OPJ_SIZE_T count, void *user) {
    auto &sink = *static_cast<Sink *>(user);
    sink.data.resize(std::max(sink.data.size(), sink.at + count));
    std::memcpy(sink.data.data() + sink.at, buffer, count);
    sink.at += count;
    return count;
}
OPJ_OFF_T skipWrite(OPJ_OFF_T count, void *user) {
    static_cast<Sink *>(user)->at += std::size_t(count);
    return count;
}
OPJ_BOOL seekWrite(OPJ_OFF_T to, void *user) {
    static_cast<Sink *>(user)->at = std::size_t(to);
    return OPJ_TRUE;
}

} // namespace

std::vector<std::byte> encodeJpeg2000(const Jpeg2000Image &in) {
    const auto fail = [] {
        throw Error(ErrorCode::internal, task::because::jpeg2000EncodingFailed);
    };
    opj_cparameters_t parameters;
    opj_set_default_encoder_parameters(&parameters);
    parameters.irreversible = 0;
    parameters.tcp_numlayers = 1;
    parameters.tcp_rates[0] = 0;
    parameters.cp_disto_alloc = 1;
    // Each resolution halves the image; small images have fewer.
    parameters.numresolution = 1;
    while (parameters.numresolution < 6 &&
           (std::min(in.rows, in.columns) >> parameters.numresolution) > 0)
        ++parameters.numresolution;
    opj_image_cmptparm_t component{};
    component.dx = component.dy = 1;
    component.w = OPJ_UINT32(in.columns);
    component.h = OPJ_UINT32(in.rows);
    component.prec = OPJ_UINT32(in.precision);
    component.sgnd = in.isSigned ? 1 : 0;
    const Image image(opj_image_create(1, &component, OPJ_CLRSPC_GRAY));
    if (!image)
        throw std::bad_alloc();
    image->x1 = component.w;
    image->y1 = component.h;
    std::copy(in.samples.begin(), in.samples.end(), image->comps[0].data);
    Sink sink;
    Stream stream(opj_stream_create(1 << 16, OPJ_FALSE));
    opj_stream_set_user_data(stream.get(), &sink, nullptr);
    opj_stream_set_write_function(stream.get(), writeBytes);
    opj_stream_set_skip_function(stream.get(), skipWrite);
    opj_stream_set_seek_function(stream.get(), seekWrite);
    const Codec codec(opj_create_compress(OPJ_CODEC_J2K));
    if (opj_setup_encoder(codec.get(), &parameters, image.get()) == OPJ_FALSE ||
        opj_start_compress(codec.get(), image.get(), stream.get()) == OPJ_FALSE ||
        opj_encode(codec.get(), stream.get()) == OPJ_FALSE ||
        opj_end_compress(codec.get(), stream.get()) == OPJ_FALSE)
        fail();
    stream.reset(); // flushes
    return std::move(sink.data);
}

} // namespace pellucid::dcmtk
