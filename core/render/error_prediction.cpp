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

AxisError axisError(const fourier::Kernel &kernel, int padded, const std::vector<double> &energy) {
    // The amplitudes change slowly: some forty positions an axis are enough.
    const int samples = int(energy.size()), bins = std::min(samples, 40);
    double ghosts = 0.0, inverse = 0.0;
    for (int bin = 0; bin < bins; ++bin) {
        const int first = bin * samples / bins, last = (bin + 1) * samples / bins;
        double e = 0.0, moment = 0.0;
        for (int n = first; n < last; ++n) {
            e += energy[n];
            moment += energy[n] * (n - samples / 2);
        }
        if (e == 0.0)
            continue;
        const double x = moment / e / padded;
        const double h = kernel.apodisation(x);
        // The kernels' transforms fall at least as 1/m beyond.
        for (const int m : {-3, -2, -1, 1, 2, 3}) {
            const double r = kernel.apodisation(x + m) / h;
            ghosts += e * r * r;
        }
        inverse += e / (h * h);
    }
    return {ghosts, kernel.energy() * inverse};
}

double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const ImageShare &share) {
    double all = 0.0, most = 0.0, noise = 1.0;
    for (const AxisError &axis : axes) {
        all += axis.ghosts;
        most = std::max(most, axis.ghosts);
        noise *= axis.noise;
    }
    // Single views scatter about what is expected: noise in seven thick slices had 1.11 times of
    // it. A margin of 1.3 (1.7 in energy) keeps the promise; wider statistics are still to be
    // taken.
    const double ghosts = 1.7 * (most + share.inImage * (all - most));
    // A rounding error is evenly spread up to half a unit in the last place, 2^-11 of the leading
    // power of two; over the mantissas that is 0.73 * 2^-11/sqrt(3).
    const double rounding = storage == fourier::Storage::binary16 ? 2.1e-4 : 3e-7;
    return std::sqrt(ghosts + rounding * rounding * noise * share.inImage);
}

} // namespace pellucid::render
