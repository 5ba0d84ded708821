// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace pellucid::volume {

namespace {

using Counts = std::vector<std::uint64_t>;

// An unsigned key with the same order as the values, so that ranks can be counted digit by digit.
std::uint32_t orderKey(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}
float fromOrderKey(std::uint32_t key) {
    return std::bit_cast<float>((key & 0x80000000U) != 0 ? key & 0x7FFFFFFFU : ~key);
}
std::uint32_t orderKey(std::int16_t value) {
    return std::uint32_t(int(value) + 32768) << 16;
}
double keyValue(std::uint32_t key, std::int16_t) {
    return int(key >> 16) - 32768;
}
double keyValue(std::uint32_t key, float) {
    return fromOrderKey(key);
}

bool isFinite(std::int16_t) {
    return true;
}
bool isFinite(float value) {
    return std::isfinite(value);
}

template <class T, class BinOf>
Counts countInto(std::span<const T> samples, std::size_t bins, const BinOf &binOf) {
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_reduce(
        Range(0, samples.size(), 1 << 20), Counts(bins, 0),
        [&](const Range &range, Counts counts) {
            for (std::size_t n = range.begin(); n != range.end(); ++n)
                if (isFinite(samples[n]))
                    if (const std::ptrdiff_t bin = binOf(samples[n]); bin >= 0)
                        ++counts[bin];
            return counts;
        },
        [](Counts a, const Counts &b) {
            std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
            return a;
        });
}

// The value of a given rank among the finite samples, by radix selection in two passes: exact for
// any type, without copying the samples.
template <class T> class RankSelector {
public:
    explicit RankSelector(std::span<const T> samples)
        : m_samples(samples),
          m_high(
              countInto(samples, 65536, [](T v) -> std::ptrdiff_t { return orderKey(v) >> 16; })) {
        for (const std::uint64_t count : m_high)
            m_total += count;
    }
    std::uint64_t total() const { return m_total; }
    double value(std::uint64_t rank) {
        const auto [digit, rest] = find(m_high, rank);
        if constexpr (std::is_same_v<T, std::int16_t>)
            return keyValue(std::uint32_t(digit) << 16, T());
        if (digit != m_lowDigit) {
            m_low = countInto(m_samples, 65536, [digit = digit](T v) -> std::ptrdiff_t {
                const std::uint32_t key = orderKey(v);
                return key >> 16 == digit ? std::ptrdiff_t(key & 0xFFFFU) : -1;
            });
            m_lowDigit = digit;
        }
        const auto [low, ignored] = find(m_low, rest);
        return keyValue(std::uint32_t(digit) << 16 | std::uint32_t(low), T());
    }

private:
    static std::pair<std::size_t, std::uint64_t> find(const Counts &counts, std::uint64_t rank) {
        std::size_t digit = 0;
        while (digit + 1 < counts.size() && rank >= counts[digit])
            rank -= counts[digit++];
        return {digit, rank};
    }
    std::span<const T> m_samples;
    Counts m_high, m_low;
    std::size_t m_lowDigit = std::numeric_limits<std::size_t>::max();
    std::uint64_t m_total = 0;
};

struct Moments {
    double sum = 0.0, sumOfSquares = 0.0;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    std::uint64_t count = 0;
};

} // namespace

Statistics statistics(const Volume &volume) {
    const Moments all = volume.visit([](auto samples) {
        using Range = tbb::blocked_range<std::size_t>;
        return tbb::parallel_deterministic_reduce(
            Range(0, samples.size(), 1 << 20), Moments(),
            [&](const Range &range, Moments m) {
                for (std::size_t n = range.begin(); n != range.end(); ++n) {
                    const double v = samples[n];
                    if (!std::isfinite(v))
                        continue;
                    m.sum += v;
                    m.sumOfSquares += v * v;
                    m.low = std::min(m.low, v);
                    m.high = std::max(m.high, v);
                    ++m.count;
                }
                return m;
            },
            [](const Moments &a, const Moments &b) {
                return Moments{a.sum + b.sum, a.sumOfSquares + b.sumOfSquares,
                               std::min(a.low, b.low), std::max(a.high, b.high), a.count + b.count};
            });
    });
    if (all.count == 0)
        return {};
    const double mean = all.sum / double(all.count);
    const double variance = std::max(0.0, all.sumOfSquares / double(all.count) - mean * mean);
    return {all.low, all.high, mean, std::sqrt(variance), all.count};
}

Histogram histogram(const Volume &volume, int bins) {
    const Statistics range = statistics(volume);
    Histogram result{range.minimum, range.maximum, {}};
    const double scale =
        range.maximum > range.minimum ? bins / (range.maximum - range.minimum) : 0.0;
    result.counts = volume.visit([&](auto samples) {
        return countInto(samples, std::size_t(bins), [&](auto v) -> std::ptrdiff_t {
            return std::clamp(int((double(v) - range.minimum) * scale), 0, bins - 1);
        });
    });
    return result;
}

std::vector<double> quantiles(const Volume &volume, const std::vector<double> &fractions) {
    return volume.visit([&](auto samples) {
        using T = std::remove_const_t<typename decltype(samples)::element_type>;
        RankSelector<T> select{std::span<const T>(samples)};
        std::vector<double> result(fractions.size(), 0.0);
        if (select.total() == 0)
            return result;
        for (std::size_t n = 0; n < fractions.size(); ++n) {
            const double rank = std::clamp(fractions[n], 0.0, 1.0) * double(select.total() - 1);
            const auto below = std::uint64_t(rank);
            const auto above = std::min(below + 1, select.total() - 1);
            const double low = select.value(below);
            result[n] = low + (rank - double(below)) * (select.value(above) - low);
        }
        return result;
    });
}

} // namespace pellucid::volume
