// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/picture/projection_image.h"
#include "core/scene/scene.h"

namespace pellucid::picture {

/// The two image values that a tone maps to black and white.
struct ToneRange {
    double low = 0.0, high = 1.0;
    bool operator==(const ToneRange &) const = default;
};

/// The tone's ends if set; otherwise 0 and the 99.8 % quantile of the pixels' brightest channels,
/// so that a few bright pixels do not darken the rest.
ToneRange toneRange(const ProjectionImage &image, const scene::Tone &tone);

/// The display curve: 0..1 within the range, x^(1/1.4), which brightens soft tissue next to bone.
/// The GLSL tone pass computes the same.
inline constexpr double toneExponent = 1.0 / 1.4;

/// The order of a pixel's four bytes; the last one is opacity.
enum class PixelOrder { rgba, bgra };
/// Four bytes for each pixel.
using Pixels = std::vector<std::uint8_t, system::RecycledAllocator<std::uint8_t>>;

/// Applies window, inversion and color. The brightest channel of a pixel gets the display curve
/// and the others keep their ratio to it, so that bright colors keep their hue; inverted colors
/// are the negative. Values below the range are black, including those below zero, where a sharp
/// band limit undershoots. *Shape*: height x width x 4, opaque.
Pixels compose(const ProjectionImage &image, const scene::Tone &tone,
               PixelOrder order = PixelOrder::rgba);

} // namespace pellucid::picture
