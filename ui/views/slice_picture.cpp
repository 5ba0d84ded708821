// SPDX-License-Identifier: GPL-3.0-or-later
// Before Qt, which defines a macro with a name that oneTBB uses.
#include <tbb/parallel_for.h>

#include "ui/views/slice_picture.h"

#include <algorithm>
#include <cmath>

namespace pellucid::ui {

namespace {

QRgb tinted(uchar grey, const classify::TissueClass &tint, double value) {
    constexpr double strength = 0.6;
    const double share = strength * tint.membership(value);
    const auto mix = [&](double part) {
        return int(std::lround((1.0 - share) * grey + share * 255.0 * part));
    };
    return qRgb(mix(tint.color.red), mix(tint.color.green), mix(tint.color.blue));
}

} // namespace

QImage slicePicture(const mpr::SliceImage &slice, const volume::ValueWindow &window,
                    const std::optional<classify::TissueClass> &tint) {
    QImage image(slice.width, slice.height,
                 tint ? QImage::Format_RGB32 : QImage::Format_Grayscale8);
    const auto ramp = window.ramp();
    const float low = ramp ? float(ramp->low) : 0.0F,
                scale = ramp ? float(255.0 / ramp->width) : 0.0F;
    const auto greyOf = [&](float value) {
        if (!ramp)
            return float(255.0 * window.greyOf(double(value)));
        const float bright = std::clamp((value - low) * scale, 0.0F, 255.0F);
        return window.isInverted ? 255.0F - bright : bright;
    };
    uchar *const bits = image.bits();
    const std::ptrdiff_t stride = image.bytesPerLine();
    tbb::parallel_for(0, slice.height, [&](int r) {
        uchar *const out = bits + r * stride;
        auto *const pixels = reinterpret_cast<QRgb *>(out);
        const float *in = slice.values.data() + std::size_t(r) * slice.width;
        for (int c = 0; c < slice.width; ++c) {
            const bool isOutside = std::isnan(in[c]);
            const auto grey = uchar(isOutside ? 0.0F : greyOf(in[c]));
            if (tint)
                pixels[c] = isOutside ? qRgb(0, 0, 0) : tinted(grey, *tint, double(in[c]));
            else
                out[c] = grey;
        }
    });
    return image;
}

} // namespace pellucid::ui
