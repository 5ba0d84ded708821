// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pellucid::volume {

/// Narrows values to the 24 bits of a float and keeps account of what that costs: large values that
/// differ by little become one number, and no window would show it.
class Narrowing {
public:
    /// *Units*: `count` values are expected; some 4096 of them are kept as they were.
    explicit Narrowing(std::size_t count);

    /// The nearest float; not finite if the value is not, or is beyond every float.
    float narrow(double value);
    /// Joins what another has seen of the same values.
    void join(const Narrowing &other);

    /// Values that were not finite.
    std::size_t notFinite() const { return m_notFinite; }
    /// What narrowing lost, as a line for the user, where it is more than 1e-5 of the values'
    /// range, or of the range of a tenth of them: a background of zeros makes no range of its own.
    std::optional<std::string> warning() const;
    /// *Throws* Error{unusable} if more than 1e-4 of the whole range was lost.
    void requireRange() const;

private:
    double m_lost = 0.0, m_least = std::numeric_limits<double>::infinity(), m_most = -m_least;
    std::size_t m_every, m_seen = 0, m_notFinite = 0;
    std::vector<double> m_some;
};

} // namespace pellucid::volume
