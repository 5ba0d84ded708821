// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace pellucid::picture {

/// The display curve with its window, see `compose`.
struct ToneCurve {
    float low = 0.0F, scale = 1.0F; ///< scale: one over the width of the range
    bool inverted = false;
    bool blueFirst = false; ///< in the bytes of a pixel
};

/// Maps `count` pixels of one or three channels to red, green, blue and 255, or to blue, green, red
/// and 255. *Shape*: `bytes`: 4 x count.
void tonePixels(const float *samples, std::size_t count, int channels, const ToneCurve &curve,
                std::uint8_t *bytes);

} // namespace pellucid::picture
