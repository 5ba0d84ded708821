// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/compose.h"

#include <algorithm>
#include <cmath>

namespace pellucid::render {

ToneRange toneRange(const ProjectionImage &image, const Tone &tone) {
    ToneRange range{tone.low.value_or(0.0), tone.high.value_or(0.0)};
    if (!tone.high) {
        // Pixels outside the patient say nothing about the patient's brightness.
        float brightest = 0.0F;
        for (const float p : image.samples)
            brightest = std::max(brightest, p);
        std::vector<float> inside;
        for (const float p : image.samples)
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

std::vector<std::uint8_t> compose(const ProjectionImage &image, const Tone &tone) {
    const ToneRange range = toneRange(image, tone);
    const auto low = float(range.low), scale = float(1.0 / (range.high - range.low));
    std::vector<std::uint8_t> rgba(image.samples.size() * 4, 255);
    for (std::size_t n = 0; n < image.samples.size(); ++n) {
        float x = std::clamp((image.samples[n] - low) * scale, 0.0F, 1.0F);
        x = std::pow(x, float(toneExponent));
        const auto grey = std::uint8_t(std::lround(255.0F * (tone.inverted ? 1.0F - x : x)));
        rgba[4 * n] = rgba[4 * n + 1] = rgba[4 * n + 2] = grey;
    }
    return rgba;
}

} // namespace pellucid::render
