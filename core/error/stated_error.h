// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::error {

/// The relative L2 error of a picture, |picture - truth|/|truth|, as far as it is known.
struct StatedError {
    enum class Kind {
        bound,   ///< the error is at most this, derived before the picture is made
        measured ///< found by exact sums over the samples, with an interval
    };
    double relative = 0.0;
    Kind kind = Kind::bound;
    /// Of a measurement: the error is in between with 98 % confidence. Of a bound: from 0 on.
    double low = 0.0, high = 0.0;
    int frequencies = 0; ///< that were summed for a measurement

    static StatedError atMost(double bound) { return {.relative = bound, .high = bound}; }
    /// The figure that must not exceed a tolerance. Where in the body an error lies is not known:
    /// all of it may be in the part that a picture shows.
    double judged(bool isWhole) const { return isWhole ? relative : high; }
    bool isMeasured() const { return kind == Kind::measured; }
    bool operator==(const StatedError &) const = default;
};

} // namespace pellucid::error
