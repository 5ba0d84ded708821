// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pellucid::volume {

/// How a window turns values into grey: the functions of DICOM's VOI LUT (PS3.3, C.11.2.1).
enum class WindowFunction {
    linearExact, ///< from 0 at center - width / 2 to 1 at center + width / 2
    linear,      ///< for whole numbers: from center - width / 2 to center + width / 2 - 1
    sigmoid,     ///< 1 / (1 + exp(-4 (value - center) / width))
    table,       ///< the curve over the width
};

/// A display window in units of the values.
struct ValueWindow {
    double center = 0.0;
    double width = 1.0;
    std::string name;
    bool isInverted = false; ///< high values are dark
    WindowFunction function = WindowFunction::linearExact;
    /// Of a table: evenly spaced greys from 0 to 1, at least two.
    std::shared_ptr<const std::vector<float>> curve{};
    bool operator==(const ValueWindow &other) const {
        return center == other.center && width == other.width && name == other.name &&
               isInverted == other.isInverted && function == other.function &&
               (curve == other.curve || (curve && other.curve && *curve == *other.curve));
    }

    /// The values between which grey changes evenly; nothing for a sigmoid or a table.
    struct Ramp {
        double low, width;
    };
    std::optional<Ramp> ramp() const {
        if (function == WindowFunction::sigmoid || function == WindowFunction::table)
            return std::nullopt;
        // Widths of less than two whole numbers have no meaning in that function.
        if (function == WindowFunction::linear && width >= 2.0)
            return Ramp{center - 0.5 * width, width - 1.0};
        return Ramp{center - 0.5 * width, width};
    }

    /// The grey of a value, from 0 (black) to 1 (white); NaN for NaN.
    double greyOf(double value) const {
        const double grey = uninverted(value);
        return isInverted ? 1.0 - grey : grey;
    }

private:
    double uninverted(double value) const {
        if (const auto even = ramp())
            return std::clamp((value - even->low) / even->width, 0.0, 1.0);
        const double from = (value - center) / width; // the middle
        if (function == WindowFunction::sigmoid)
            return 1.0 / (1.0 + std::exp(-4.0 * from));
        if (std::isnan(from))
            return from;
        const double place = std::clamp(from + 0.5, 0.0, 1.0) * double(curve->size() - 1);
        const auto below = std::min(std::size_t(place), curve->size() - 2);
        const double share = place - double(below);
        return (1.0 - share) * (*curve)[below] + share * (*curve)[below + 1];
    }
};

} // namespace pellucid::volume
