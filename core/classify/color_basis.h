// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

namespace pellucid::classify {

/// As few colors as all of a look can be mixed from: their number is the rank of the colors. A
/// picture needs one image for each, whatever the number of classes.
struct ColorBasis {
    using Rgb = std::array<double, 3>;
    static constexpr std::array<Rgb, 3> primaries{
        {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    std::vector<Rgb> colors; ///< one to three
    /// The amount of each basis color in each color of the look. Not negative, except that rounding
    /// may leave -1e-16, if no component of a color is. *Shape*: one entry for each color of the
    /// look; beyond the basis, 0.
    using Amounts = std::array<double, 3>;
    std::vector<Amounts> amounts;
};

/// Colors of one hue are mixed from the brightest. Colors in a plane through black are mixed from
/// the two that are farthest apart, others from red, green and blue. Colors within 1e-7 of a line
/// or plane are in it, which no single-precision picture shows. *Requires*: a color that is not
/// black.
ColorBasis colorBasis(std::span<const ColorBasis::Rgb> colors);

} // namespace pellucid::classify
