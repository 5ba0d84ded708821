// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace pellucid::render {

EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size();
    const volume::GridSize size = box.size();
    const EnergyMarginals zero{{std::vector<double>(size.i, 0.0), std::vector<double>(size.j, 0.0),
                                std::vector<double>(size.k, 0.0)},
                               0.0};
    EnergyMarginals sums = field.visit([&](auto samples) {
        return tbb::parallel_deterministic_reduce(
            tbb::blocked_range<int>(0, size.k, 8), zero,
            [&](const tbb::blocked_range<int> &range, EnergyMarginals sum) {
                for (int k = range.begin(); k != range.end(); ++k)
                    for (int j = 0; j < size.j; ++j) {
                        const std::size_t row =
                            (std::size_t(k + box.lo.k) * lattice.j + j + box.lo.j) * lattice.i +
                            box.lo.i;
                        double inRow = 0.0, mass = 0.0;
                        for (int i = 0; i < size.i; ++i) {
                            const double f = double(samples[row + i]);
                            sum.axis[0][i] += f * f;
                            inRow += f * f;
                            mass += f;
                        }
                        sum.effectiveSamples += mass; // the sum of f until the end
                        sum.axis[1][j] += inRow;
                        sum.axis[2][k] += inRow;
                    }
                return sum;
            },
            [](EnergyMarginals a, const EnergyMarginals &b) {
                for (int d = 0; d < 3; ++d)
                    std::transform(a.axis[d].begin(), a.axis[d].end(), b.axis[d].begin(),
                                   a.axis[d].begin(), std::plus<>());
                a.effectiveSamples += b.effectiveSamples;
                return a;
            });
    });
    double total = 0.0;
    for (const double e : sums.axis[2])
        total += e;
    const double mass = sums.effectiveSamples;
    sums.effectiveSamples = total > 0.0 ? std::max(1.0, mass * mass / total) : 1.0;
    if (total > 0.0)
        for (auto &axis : sums.axis)
            for (double &e : axis)
                e /= total;
    return sums;
}

double ringingPixels(double rollOff) {
    return 4.0 / std::max(1.0 / 64.0, rollOff);
}

double predictFoldedTails(double rollOff, double roomPixels, double share,
                          double effectiveSamples) {
    const double r = std::max(1.0, roomPixels);
    const double sharp = std::sqrt(2.0 / r) / std::numbers::pi;
    const double rolled = 0.3 / (std::max(rollOff, 1e-6) * r);
    return sharp * std::min(1.0, rolled * rolled) * share / std::pow(effectiveSamples, 0.25);
}

double predictRelativeError(const fourier::SpectrumLayout &layout, const EnergyMarginals &energy) {
    double product = 1.0;
    for (int d = 0; d < 3; ++d) {
        const int samples = int(energy.axis[d].size());
        const int padded = layout.padded[d];
        double ghosts = 0.0;
        for (int n = 0; n < samples; ++n) {
            if (energy.axis[d][n] == 0.0)
                continue;
            const double x = n - samples / 2;
            const double h = layout.kernel.apodisation(x, padded);
            // Beyond the second period the kernels have fallen by more than (1/w)^2 again.
            for (const int m : {-2, -1, 1, 2}) {
                const double r = layout.kernel.apodisation(x + m * padded, padded) / h;
                ghosts += energy.axis[d][n] * r * r;
            }
        }
        product *= 1.0 + ghosts;
    }
    return std::sqrt(product - 1.0);
}

} // namespace pellucid::render
