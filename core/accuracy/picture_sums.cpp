// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/picture_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pellucid::accuracy {

namespace {

// A filter that passes only frequencies within 0.06 cycles per pixel of the highest one, where the
// tails of the roll-off come from: cos^4 centred on half the sampling rate. It passes 1e-12 of
// frequency 0, as energy.
class EdgeFilter {
public:
    EdgeFilter() {
        double squares = 0.0;
        for (int n = -reach; n <= reach; ++n) {
            const double cosine = std::cos(0.5 * std::numbers::pi * n / (reach + 1));
            const double factor = (n % 2 == 0 ? 1.0 : -1.0) * std::pow(cosine, 4);
            m_factors[std::size_t(n + reach)] = factor;
            squares += factor * factor;
        }
        for (double &factor : m_factors)
            factor /= std::sqrt(squares);
    }

    // The energies of a line and of its filtered version. The line's ends are extended as
    // constants.
    template <class Value> std::array<double, 2> energies(int length, const Value &value) {
        m_line.resize(std::size_t(length + 2 * reach));
        m_filtered.assign(std::size_t(length), 0.0);
        for (int n = -reach; n < length + reach; ++n)
            m_line[std::size_t(n + reach)] = value(std::clamp(n, 0, length - 1));
        for (std::size_t tap = 0; tap < m_factors.size(); ++tap)
            for (std::size_t n = 0; n < m_filtered.size(); ++n)
                m_filtered[n] += m_factors[tap] * m_line[n + tap];
        std::array<double, 2> sums{};
        for (std::size_t n = 0; n < m_filtered.size(); ++n) {
            sums[0] += m_line[n + reach] * m_line[n + reach];
            sums[1] += m_filtered[n] * m_filtered[n];
        }
        return sums;
    }

private:
    static constexpr int reach = 24;
    std::array<double, 2 * reach + 1> m_factors{};
    std::vector<double> m_line, m_filtered;
};

} // namespace

PictureSums pictureSums(const picture::ProjectionImage &picture, int channel) {
    const auto value = [&](int row, int column) {
        return double(picture.samples[(std::size_t(row) * picture.width + column) *
                                          std::size_t(picture.channels) +
                                      std::size_t(channel)]);
    };
    EdgeFilter filter;
    // A subset of the lines of a large picture is enough.
    constexpr int enough = 64;
    const auto along = [&](int lines, int length, const auto &sample) {
        std::array<double, 2> sums{};
        const int step = std::max(1, lines / enough);
        for (int line = 0; line < lines; line += step) {
            const auto energies = filter.energies(length, [&](int n) { return sample(line, n); });
            sums[0] += step * energies[0];
            sums[1] += step * energies[1];
        }
        return sums;
    };
    const auto rows =
        along(picture.height, picture.width, [&](int line, int n) { return value(line, n); });
    const auto columns =
        along(picture.width, picture.height, [&](int line, int n) { return value(n, line); });
    const auto share = [](const std::array<double, 2> &sums) {
        return sums[0] > 0.0 ? std::min(1.0, sums[1] / sums[0]) : 0.0;
    };
    double energy = 0.0;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column)
            energy += value(row, column) * value(row, column);
    return {energy, share(rows), share(columns)};
}

} // namespace pellucid::accuracy
