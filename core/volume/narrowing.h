// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
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
    /// `count`: of the values to come, some 4096 of which are kept as they were.
    explicit Narrowing(std::size_t count);

    /// The nearest float; not finite if the value is not, or is beyond every float.
    float narrow(double value) {
        const auto kept = float(value);
        if (!std::isfinite(kept)) {
            ++m_notFinite;
            return kept;
        }
        m_lost = std::max(m_lost, std::abs(value - double(kept)));
        m_least = std::min(m_least, value);
        m_most = std::max(m_most, value);
        if (m_seen++ % m_every == 0)
            m_some.push_back(value);
        return kept;
    }
    /// Joins what another has seen of the same values.
    void join(const Narrowing &other);

    /// Values that were not finite.
    std::size_t notFinite() const { return m_notFinite; }
    /// What narrowing lost, as a line for the user, where it is more than 1e-5 of the values'
    /// range, or of the range of a tenth of them between wide gaps: a background of zeros beside
    /// large values makes no range for them.
    std::optional<std::string> warning() const;
    /// *Throws* Error{unusable} if more than 1e-4 of the whole range was lost.
    void requireRange() const;

private:
    double m_lost = 0.0, m_least = std::numeric_limits<double>::infinity(), m_most = -m_least;
    std::size_t m_every; ///< odd, or every kept value could be of the same column
    std::size_t m_seen = 0, m_notFinite = 0;
    std::vector<double> m_some;
};

} // namespace pellucid::volume
