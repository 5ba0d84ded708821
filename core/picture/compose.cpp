// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/compose.h"

#include <algorithm>
#include <cmath>
#include <span>

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

ToneRange rangeOf(std::span<const float> pixels, const scene::Tone &tone) {
    ToneRange range{tone.low.value_or(0.0), tone.high.value_or(0.0)};
    if (!tone.high) {
        // Pixels outside the patient are no measure of the patient's brightness.
        float brightest = 0.0F;
        for (const float p : pixels)
            brightest = std::max(brightest, p);
        std::vector<float> inside;
        for (const float p : pixels)
            if (p > 1e-3F * brightest)
                inside.push_back(p);
        if (!inside.empty()) {
            const auto at = inside.begin() + std::ptrdiff_t(0.998 * double(inside.size() - 1));
            std::nth_element(inside.begin(), at, inside.end());
            range.high = *at;
        }
    }
    if (!(range.high > range.low))
        range.high = range.low + 1.0;
    return range;
}

} // namespace

ToneRange toneRange(const ProjectionImage &image, const scene::Tone &tone) {
    return rangeOf(brightness(image), tone);
}

std::vector<std::uint8_t> compose(const ProjectionImage &image, const scene::Tone &tone) {
    const Samples pixels = brightness(image);
    const ToneRange range = rangeOf(pixels, tone);
    const auto low = float(range.low), scale = float(1.0 / (range.high - range.low));
    const float lift = std::min(0.0F, low);
    std::vector<std::uint8_t> rgba(pixels.size() * 4, 255);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
        const float most =
            std::pow(std::clamp((pixels[n] - low) * scale, 0.0F, 1.0F), float(toneExponent));
        const float largest = std::max(0.0F, pixels[n]);
        for (int c = 0; c < 3; ++c) {
            float x = most;
            // A range that starts below zero raises empty pixels to a grey without hue.
            if (image.channels == 3 && largest > lift)
                x *= (std::max(0.0F, image.samples[3 * n + std::size_t(c)]) - lift) /
                     (largest - lift);
            rgba[4 * n + std::size_t(c)] =
                std::uint8_t(std::lround(255.0F * (tone.inverted ? 1.0F - x : x)));
        }
    }
    return rgba;
}

} // namespace pellucid::picture
