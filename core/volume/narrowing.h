// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/task/reason.h"

namespace pellucid::volume {

/// Narrows values to the 24 bits of a float, and determines the loss: large values with small
/// differences become equal, and no window would reveal it.
class Narrowing {
public:
    /// *Shape*: `count` values in total, of which those from `first` on follow; about 4096 of all
    /// are kept for comparison.
    explicit Narrowing(std::size_t count, std::size_t first = 0);

    /// The nearest float; not finite if the value is not, or is beyond every float.
    float narrow(double value) {
        const auto kept = float(value);
        if (!std::isfinite(kept)) {
            ++m_notFinite;
            return kept;
        }
        m_lost = std::max(m_lost, std::abs(value - double(kept)));
        m_smallest = std::min(m_smallest, value);
        m_largest = std::max(m_largest, value);
        if (--m_untilKept == 0)
            keep(value);
        return kept;
    }
    /// Adds the statistics of another part of the volume.
    void join(const Narrowing &other);

    /// The number of values that were not finite.
    std::size_t notFinite() const { return m_notFinite; }
    /// A warning for the user if more than 5 % of the differences between kept values are lost.
    std::optional<task::Reason> warning() const;
    /// *Throws* Error{unusable} if more than half of them are lost and rounding exceeds 1e-4 of the
    /// range of all values.
    void requireDistinct() const;

private:
    struct Merged {
        double share = 0.0;   ///< fraction of neighbouring values that became equal
        double largest = 0.0; ///< difference between such neighbours
    };
    Merged merged() const;
    void keep(double value);

    double m_lost = 0.0, m_smallest = std::numeric_limits<double>::infinity(),
           m_largest = -m_smallest;
    std::size_t m_every, m_untilKept, m_notFinite = 0;
    std::vector<double> m_kept;
};

} // namespace pellucid::volume
