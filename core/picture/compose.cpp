// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/compose.h"

#include <algorithm>
#include <span>

#include <tbb/parallel_for.h>

#include "core/picture/tone_pixels.h"

namespace pellucid::picture {

namespace {

// The brightest channel of each pixel.
Samples brightness(const ProjectionImage &image) {
    if (image.channels == 1)
        return image.samples;
    Samples most(image.samples.size() / std::size_t(image.channels));
    for (std::size_t n = 0; n < most.size(); ++n) {
        const float *const pixel = image.samples.data() + n * std::size_t(image.channels);
        most[n] = *std::max_element(pixel, pixel + image.channels);
    }
    return most;
}

double automaticHigh(std::span<const float> pixels) {
    // Pixels outside the patient are no measure of the patient's brightness.
    float brightest = 0.0F;
    for (const float p : pixels)
        brightest = std::max(brightest, p);
    std::vector<float> inside;
    for (const float p : pixels)
        if (p > 1e-3F * brightest)
            inside.push_back(p);
    if (inside.empty())
        return 0.0;
    const auto at = inside.begin() + std::ptrdiff_t(0.998 * double(inside.size() - 1));
    std::nth_element(inside.begin(), at, inside.end());
    return *at;
}

} // namespace

ToneRange toneRange(const ProjectionImage &image, const scene::Tone &tone) {
    ToneRange range{tone.low.value_or(0.0),
                    tone.high ? *tone.high : automaticHigh(brightness(image))};
    if (!(range.high > range.low))
        range.high = range.low + 1.0;
    return range;
}

Pixels compose(const ProjectionImage &image, const scene::Tone &tone, PixelOrder order) {
    const ToneRange range = toneRange(image, tone);
    const ToneCurve curve{float(range.low), float(1.0 / (range.high - range.low)), tone.inverted,
                          order == PixelOrder::bgra};
    const auto channels = std::size_t(image.channels);
    const std::size_t pixels = image.samples.size() / channels;
    Pixels bytes(4 * pixels);
    constexpr std::size_t block = 1U << 14U;
    tbb::parallel_for(std::size_t(0), (pixels + block - 1) / block, [&](std::size_t n) {
        const std::size_t first = n * block;
        tonePixels(image.samples.data() + channels * first, std::min(block, pixels - first),
                   image.channels, curve, bytes.data() + 4 * first);
    });
    return bytes;
}

} // namespace pellucid::picture
