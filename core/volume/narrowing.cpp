// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/narrowing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/task/error.h"

namespace pellucid::volume {

namespace {

constexpr std::size_t enough = 4096;

double lostOf(double value) {
    return std::abs(value - double(float(value)));
}

} // namespace

Narrowing::Narrowing(std::size_t count) : m_every((count / enough) | 1) {}

void Narrowing::join(const Narrowing &other) {
    m_lost = std::max(m_lost, other.m_lost);
    m_least = std::min(m_least, other.m_least);
    m_most = std::max(m_most, other.m_most);
    m_seen += other.m_seen;
    m_notFinite += other.m_notFinite;
    m_some.insert(m_some.end(), other.m_some.begin(), other.m_some.end());
}

std::optional<std::string> Narrowing::warning() const {
    constexpr double mostLost = 1e-5; // of a range, a hundredth of the usual tolerance
    const auto text = [](double lost) {
        return fmt::format("values that differ by less than {:.2g} are shown as equal", 2.0 * lost);
    };
    if (m_lost == 0.0)
        return std::nullopt;
    if (m_lost > mostLost * (m_most - m_least) && m_most > m_least)
        return text(m_lost);
    // The values between the widest gaps; what double precision leaves of a constant has no range.
    constexpr std::size_t gapCount = 8;
    constexpr double leastShare = 0.1, ofDoubles = 1e-12;
    std::vector<double> sorted = m_some;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::size_t> ends;
    for (std::size_t n = 1; n < sorted.size(); ++n)
        ends.push_back(n);
    const std::size_t cut = std::min(gapCount, ends.size());
    std::partial_sort(ends.begin(), ends.begin() + std::ptrdiff_t(cut), ends.end(),
                      [&](std::size_t a, std::size_t b) {
                          return sorted[a] - sorted[a - 1] > sorted[b] - sorted[b - 1];
                      });
    ends.resize(cut);
    std::sort(ends.begin(), ends.end());
    ends.push_back(sorted.size());
    std::size_t first = 0;
    double worst = 0.0;
    for (const std::size_t end : ends) {
        if (double(end - first) >= leastShare * double(sorted.size())) {
            const double range = sorted[end - 1] - sorted[first],
                         size = std::max(std::abs(sorted[end - 1]), std::abs(sorted[first]));
            double lost = 0.0;
            for (std::size_t n = first; n < end; ++n)
                lost = std::max(lost, lostOf(sorted[n]));
            if (range > ofDoubles * size && lost > mostLost * range)
                worst = std::max(worst, lost);
        }
        first = end;
    }
    return worst > 0.0 ? std::optional(text(worst)) : std::nullopt;
}

void Narrowing::requireRange() const {
    constexpr double mostLost = 1e-4;
    if (m_most > m_least && m_lost > mostLost * (m_most - m_least))
        throw task::Error(
            task::ErrorCode::unusable,
            fmt::format("its values, from {} to {}, differ by less than 24 bits can tell", m_least,
                        m_most));
}

} // namespace pellucid::volume
