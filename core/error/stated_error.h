// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::error {

/// How much of the fields a picture shows.
enum class Shown { whole, part };

/// The relative L2 error of a picture, |picture - truth|/|truth|, as far as it is known.
struct StatedError {
    /// Larger errors are cut to this: a picture in binary32 has no digits for so small a truth.
    static constexpr double largest = 0x1p24;

    enum class Kind {
        bound,   ///< the error is at most this, derived before the picture is made
        measured ///< found by exact sums over the samples, with an interval
    };
    double relative = 0.0;
    Kind kind = Kind::bound;
    /// A measured error lies between them with 98 % confidence; for a part, they are relative to
    /// the largest and the smallest truth that the picture allows. For a bound, `low` is 0.
    double low = 0.0, high = 0.0;
    int frequencies = 0; ///< that were summed for a measurement

    static StatedError atMost(double bound) { return {.relative = bound, .high = bound}; }
    /// The figure that must not exceed a tolerance. Where in the body an error lies is not known:
    /// all of it may be in the part that a picture shows.
    double judged(Shown shown) const { return shown == Shown::whole ? relative : high; }
    /// Whether all that the picture shows may be error: no plan can be made for so little truth.
    bool mayBeAll(Shown shown) const { return judged(shown) >= 1.0; }
    bool isMeasured() const { return kind == Kind::measured; }
    bool operator==(const StatedError &) const = default;
};

} // namespace pellucid::error
