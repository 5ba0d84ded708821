// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/picture/display.h"
#include "core/picture/projection_image.h"

namespace pellucid::picture {

/// The order of a pixel's four bytes; the last one is opacity.
enum class PixelOrder { rgba, bgra };
/// Four bytes for each pixel.
using Pixels = std::vector<std::uint8_t, system::RecycledAllocator<std::uint8_t>>;

/// The brightest channel of each pixel.
Samples brightnessOf(const ProjectionImage &image);

/// Applies contrast, range, display curve, inversion and color. All act on the brightest channel of
/// a pixel, and the others keep their ratio to it, so that bright colors keep their hue; inverted
/// colors are the negative. Values below the range are black, including those below zero, where a
/// sharp band limit undershoots. The GLSL passes compute the same. *Shape*: height x width x 4,
/// opaque.
Pixels compose(const ProjectionImage &image, const Display &display,
               PixelOrder order = PixelOrder::rgba);

/// Grey in 16 bits, linear from the lower to the upper end of the range, as the values are
/// measured. *Shape*: height x width. `isWhole`: the range is extended, so that no high value is
/// cut off. *Requires*: one channel.
std::vector<std::uint16_t> greyOf(const ProjectionImage &image, const Display &display,
                                  bool isWhole);

} // namespace pellucid::picture
