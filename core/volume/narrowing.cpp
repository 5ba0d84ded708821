// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/narrowing.h"

#include <fmt/format.h>

#include "core/task/error.h"
#include "core/volume/reasons.h"

namespace pellucid::volume {

namespace {

constexpr std::size_t enough = 4096;

} // namespace

// An odd stride, otherwise the kept values could all come from a few columns.
Narrowing::Narrowing(std::size_t count, std::size_t first)
    : m_every((count / enough) | 1), m_untilKept(m_every - first % m_every) {}

void Narrowing::keep(double value) {
    m_kept.push_back(value);
    m_untilKept = m_every;
}

void Narrowing::join(const Narrowing &other) {
    m_lost = std::max(m_lost, other.m_lost);
    m_smallest = std::min(m_smallest, other.m_smallest);
    m_largest = std::max(m_largest, other.m_largest);
    m_notFinite += other.m_notFinite;
    m_kept.insert(m_kept.end(), other.m_kept.begin(), other.m_kept.end());
}

Narrowing::Merged Narrowing::merged() const {
    Merged result;
    if (m_lost == 0.0)
        return result;
    // Differences no larger than the rounding of a constant in double precision do not count.
    const double least = 1e-12 * std::max(std::abs(m_smallest), std::abs(m_largest));
    std::vector<double> sorted = m_kept;
    std::sort(sorted.begin(), sorted.end());
    std::size_t different = 0, equal = 0;
    for (std::size_t n = 1; n < sorted.size(); ++n) {
        const double difference = sorted[n] - sorted[n - 1];
        if (difference <= least)
            continue;
        ++different;
        if (float(sorted[n]) == float(sorted[n - 1])) {
            ++equal;
            result.largest = std::max(result.largest, difference);
        }
    }
    result.share = different > 0 ? double(equal) / double(different) : 0.0;
    return result;
}

std::optional<task::Reason> Narrowing::warning() const {
    constexpr double maxUnreported = 0.05;
    const Merged loss = merged();
    if (loss.share <= maxUnreported)
        return std::nullopt;
    return task::because::valuesAreShownAsEqual(fmt::format("{:.2g}", loss.largest));
}

void Narrowing::requireDistinct() const {
    constexpr double maxMerged = 0.5, maxLost = 1e-4;
    if (m_lost > maxLost * (m_largest - m_smallest) && merged().share > maxMerged)
        throw task::Error(task::ErrorCode::unusable,
                          task::because::valuesAreOne(fmt::format("{}", m_smallest),
                                                      fmt::format("{}", m_largest)));
}

} // namespace pellucid::volume
