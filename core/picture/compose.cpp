// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/picture/compose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/picture/contrast.h"
#include "core/picture/contrast_rows.h"
#include "core/picture/tone_pixels.h"

namespace pellucid::picture {

Samples brightnessOf(const ProjectionImage &image) {
    if (image.channels == 1)
        return image.samples;
    Samples most(image.samples.size() / std::size_t(image.channels));
    for (int row = 0; row < image.height; ++row) {
        const std::size_t first = std::size_t(row) * std::size_t(image.width);
        brightest(image.samples.data() + first * std::size_t(image.channels), image.width,
                  image.channels, most.data() + first);
    }
    return most;
}

Pixels compose(const ProjectionImage &image, const Display &display, PixelOrder order) {
    const ToneRange &range = display.range;
    const ToneCurve curve{.low = float(range.low),
                          .scale = float(1.0 / (range.high - range.low)),
                          .exponent = float(display.exponent),
                          .air = float(display.air),
                          .airFade = float(std::max(0.0, display.airFade)),
                          .inverted = display.inverted,
                          .blueFirst = order == PixelOrder::bgra};
    std::optional<ContrastCorrection> correction;
    if (!display.contrast.isOff() && image.width > 0 && image.height > 0)
        correction.emplace(image, display);
    const auto channels = std::size_t(image.channels), width = std::size_t(image.width);
    Pixels bytes(4 * width * std::size_t(image.height));
    constexpr std::size_t pixelsAtOnce = 1U << 14U;
    const int grain = int(std::max<std::size_t>(1, pixelsAtOnce / std::max<std::size_t>(1, width)));
    tbb::parallel_for(tbb::blocked_range<int>(0, image.height, std::size_t(grain)),
                      [&](const auto &rows) {
                          std::vector<float> corrections(
                              correction ? width + std::size_t(ContrastCorrection::slack) : 0);
                          for (int row = rows.begin(); row < rows.end(); ++row) {
                              const std::size_t first = std::size_t(row) * width;
                              if (correction)
                                  correction->row(row, corrections.data());
                              tonePixels(image.samples.data() + channels * first,
                                         correction ? corrections.data() : nullptr, width,
                                         image.channels, curve, bytes.data() + 4 * first);
                          }
                      });
    return bytes;
}

std::vector<std::uint16_t> greyOf(const ProjectionImage &image, const Display &display,
                                  bool isWhole) {
    assert(image.channels == 1);
    ToneRange range = display.range;
    if (isWhole)
        range.high = std::max(
            range.high, double(*std::max_element(image.samples.begin(), image.samples.end())));
    constexpr double white = 65535.0;
    const double scale = white / (range.high - range.low);
    std::vector<std::uint16_t> grey;
    grey.reserve(image.samples.size());
    for (const float sample : image.samples) {
        const double value = std::clamp((double(sample) - range.low) * scale, 0.0, white);
        grey.push_back(std::uint16_t(std::lround(display.inverted ? white - value : value)));
    }
    return grey;
}

} // namespace pellucid::picture
