// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace pellucid::picture {

/// The display curve with its range, see `compose`.
struct ToneCurve {
    float low = 0.0F, scale = 1.0F; ///< scale: one over the width of the range
    float exponent = 1.0F;
    float air = 0.0F, airFade = 0.0F; ///< see `Display`
    bool inverted = false;
    bool blueFirst = false; ///< in the bytes of a pixel
};

/// Maps `count` pixels of one or three channels to red, green, blue and 255, or to blue, green, red
/// and 255. `corrections`: added to the pixels' brightness; may be null. *Shape*: `bytes`:
/// 4 x count.
void tonePixels(const float *samples, const float *corrections, std::size_t count, int channels,
                const ToneCurve &curve, std::uint8_t *bytes);

} // namespace pellucid::picture
