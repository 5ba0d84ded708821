// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/value_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <tbb/parallel_for.h>

namespace pellucid::classify {

namespace {

// f B(f) between steps of this size differs from its chord by h^2/8 times its second derivative:
// 1e-6 for sixteen points that alternate between 0 and 2, the steepest possible. Over a narrow
// range the curve is steeper, and the steps are smaller. In the one step that contains an end of
// the range, where the curve has a corner, the difference is up to 4e-4.
constexpr int fewestSteps = 16384;

int stepsFor(double range) {
    return int(std::ceil(fewestSteps / range));
}

using Shares = std::array<float, 3>;

Shares sharesOf(std::span<const WeightedCurve> curves, float value, Region region) {
    Shares sum{};
    for (const WeightedCurve &c : curves) {
        const float shown = c.curve.at(value, region);
        for (std::size_t n = 0; n < sum.size(); ++n)
            sum[n] += float(c.weights[n]) * shown;
    }
    return sum;
}

// A table for all 16-bit values.
std::vector<Shares> tableOf(std::span<const WeightedCurve> curves) {
    using Limits = std::numeric_limits<std::int16_t>;
    std::vector<Shares> table(std::size_t(Limits::max() - Limits::min() + 1));
    tbb::parallel_for(std::size_t(0), table.size(), [&](std::size_t n) {
        table[n] = sharesOf(curves, float(Limits::min()) + float(n), Region::inside);
    });
    return table;
}

} // namespace

ValueCurve::ValueCurve(const FieldWindow &window, DensityKind density,
                       std::optional<TissueClass> tissue,
                       const std::function<double(double)> &shape, double range)
    : m_low(float(window.low)), m_scale(0.0F), m_density(density), m_tissue(std::move(tissue)) {
    double width = window.high - window.low;
    if (density == DensityKind::range && m_tissue && m_tissue->hasRange()) {
        m_low = 0.0F;
        width = m_tissue->high;
    }
    if (width > 0.0)
        m_scale = float(1.0 / width);
    if (!shape)
        return;
    const int steps = stepsFor(range);
    m_table.resize(std::size_t(steps) + 2);
    for (int n = 0; n <= steps; ++n) {
        const double f = double(n) / steps;
        m_table[std::size_t(n)] = float(f * shape(f));
    }
    m_table.back() = m_table[std::size_t(steps)]; // the right neighbour of f = 1
}

float ValueCurve::at(float value, Region region) const {
    if (region == Region::outside || std::isnan(value))
        return 0.0F;
    const float scaled = (value - m_low) * m_scale;
    // Infinity times a window of zero width is NaN, which becomes 0 here.
    const float f = m_density == DensityKind::one ? 1.0F
                    : scaled >= 1.0F              ? 1.0F
                    : scaled > 0.0F               ? scaled
                                                  : 0.0F;
    float shown = f;
    if (!m_table.empty()) {
        const float at = f * float(m_table.size() - 2);
        const int left = int(at);
        const float *const pair = m_table.data() + left;
        shown = pair[0] + (at - float(left)) * (pair[1] - pair[0]);
    }
    // A filled sample belongs to the class whatever its value.
    if (m_tissue && shown > 0.0F && region != Region::filled)
        shown = float(double(shown) * m_tissue->membership(double(value)));
    return shown;
}

void addCurves(const ClassSamples &from, std::span<const WeightedCurve> curves,
               std::span<std::vector<float>> sums, const task::Progress &progress) {
    const volume::GridSize size = from.values.lattice().size();
    const std::vector<Region> *const regions = from.regions.get();
    const volume::Coverage *const coverage = from.coverage.get();
    const volume::VoxelBox box =
        coverage != nullptr ? coverage->box : from.values.lattice().bounds();
    const auto addPlanes = [&](auto samples, const auto &shares) {
        tbb::parallel_for(box.lo.k, box.hi.k, [&](int k) {
            progress.check();
            for (int j = box.lo.j; j < box.hi.j; ++j) {
                const std::size_t row = size.offsetOf(0, j, k);
                const std::uint8_t *const part =
                    coverage != nullptr
                        ? coverage->shares.data() + coverage->offsetOf({box.lo.i, j, k})
                        : nullptr;
                for (int i = box.lo.i; i < box.hi.i; ++i) {
                    const std::size_t n = row + std::size_t(i);
                    const Region where = regions != nullptr ? (*regions)[n] : Region::inside;
                    const std::uint8_t covered = part != nullptr ? part[i - box.lo.i] : 255;
                    if (where == Region::outside || covered == 0)
                        continue;
                    const Shares share = shares(samples[n], where);
                    const float scale = float(covered) / float(volume::Coverage::whole);
                    for (std::size_t c = 0; c < sums.size(); ++c)
                        sums[c][n] += scale * share[c];
                }
            }
        });
    };
    from.values.visit([&](auto samples) {
        using T = std::remove_const_t<typename decltype(samples)::element_type>;
        if constexpr (std::is_same_v<T, std::int16_t>) {
            const std::vector<Shares> table = tableOf(curves);
            addPlanes(samples, [&](T value, Region where) {
                return where == Region::inside
                           ? table[std::size_t(value - std::numeric_limits<T>::min())]
                           : sharesOf(curves, float(value), where);
            });
        } else {
            addPlanes(samples,
                      [&](T value, Region where) { return sharesOf(curves, value, where); });
        }
    });
    progress.report(1.0);
}

} // namespace pellucid::classify
