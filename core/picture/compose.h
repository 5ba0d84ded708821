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

/// The tone's ends where they are given, else 0 and the 99.8 % quantile of the pixels' brightest
/// channels, so that a few bright pixels do not darken the rest.
ToneRange toneRange(const ProjectionImage &image, const scene::Tone &tone);

/// The display curve: 0..1 within the range, x^(1/1.4), which lifts soft tissue beside bone.
/// The GLSL tone pass computes the same.
inline constexpr double toneExponent = 1.0 / 1.4;

/// Window, inversion, grey or colour. The brightest channel of a pixel takes the display curve and
/// the others keep their ratio to it, so that bright colours stay what they are; a film of colours
/// is their negative. What is below the range is black: below zero too, where a sharp band limit
/// undershoots. *Shape*: height x width x 4, opaque.
std::vector<std::uint8_t> compose(const ProjectionImage &image, const scene::Tone &tone);

} // namespace pellucid::picture
