// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/classify/step.h"
#include "core/classify/transfer_function.h"

namespace pellucid::classify {

/// Linear light, each 0..1.
struct Color {
    double red = 1.0, green = 1.0, blue = 1.0;
    bool operator==(const Color &) const = default;
};

/// "#rrggbb" as linear light: each component divided by 255. *Throws* Error{usage}.
Color colorFromText(const std::string &text);
std::string colorText(const Color &color);
/// One of a series of colors in which any number of neighbours differ.
Color distinctColor(std::size_t index);

/// Samples grouped by value, and how they are shown. *Source*: Cheng 2007, eq. 32, with soft edges
/// instead of a threshold, which rings.
struct TissueClass {
    std::string name;
    double low = 0.0, high = 1.0; ///< the range, in units of the values
    /// The width over which membership rises from 0 to 1 around `low`, and falls around `high`.
    double softness = 0.0;
    double weight = 1.0;
    Color color;
    std::optional<TransferFunction> transferFunction;
    /// Preceding steps, in this order: those that change values come first.
    std::vector<Step> steps;
    /// The name of the segment that the class is a part of; empty: of the whole volume.
    std::string segment;
    /// Fades the borders of a region that the segment or the steps define, which would ring, as a
    /// Gaussian of this standard deviation does. *Units*: samples, 0 to `softestEdge`.
    double edge = 0.0;
    /// The class is empty before its steps, which add to it: a region drawn by hand.
    bool isDrawn = false;
    bool operator==(const TissueClass &) const = default;

    /// 0 to 1: a raised cosine around each end of the range.
    double membership(double value) const;
    /// Whether some values are outside the range.
    bool hasRange() const;
    /// Whether values alone decide which samples belong to the class.
    bool isRange() const { return steps.empty() && segment.empty() && !isDrawn; }
};

/// A range that contains every value, for classes that a segment defines.
inline constexpr double lowestValue = -1e9, highestValue = 1e9;
/// The edge of a segment's class unless another is chosen.
inline constexpr double defaultEdge = 0.5, softestEdge = 4.0;

inline constexpr std::size_t maxSteps = 64;
/// Of classes within classes. Deeper ones are of no use, and reading them would exhaust the stack.
inline constexpr int maxDepth = 8;

/// *Throws* Error{usage} naming the class and the value that is out of range. The operands of its
/// steps may be missing: `validate(const Look &)` finds that.
void validate(const TissueClass &tissue);

/// The named classes for CT: air, lung, fat, fluid, muscle, organ, contrast, bone, metal, body,
/// edges.
const std::vector<TissueClass> &standardClasses();
/// Those for differences of volumes: gain and loss.
const std::vector<TissueClass> &differenceClasses();

} // namespace pellucid::classify
