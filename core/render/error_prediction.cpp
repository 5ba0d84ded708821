// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace pellucid::render {

namespace {

// Single views scatter about what is expected; this much more energy than expected was the worst of
// the views of the fields in the bench's hard suite.
constexpr double viewMargin = 1.15;
// The same of tails and of rounding, which a few points and a few cells can decide.
constexpr double fewMargin = 3.0;

double roughness(const std::vector<double> &image, int columns, int rows) {
    const auto at = [&](int column, int row) {
        return column < 0 || row < 0 || column >= columns || row >= rows
                   ? 0.0
                   : image[std::size_t(row) * columns + column];
    };
    double differences = 0.0, energy = 0.0;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double here = at(column, row), across = here - at(column - 1, row),
                         down = here - at(column, row - 1);
            energy += here * here;
            differences += across * across + down * down;
        }
    return energy > 0.0 ? std::min(1.0, differences / (4.0 * energy)) : 1.0;
}

} // namespace

EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size();
    const volume::GridSize size = box.size();
    const EnergyMarginals zero{{std::vector<double>(size.i, 0.0), std::vector<double>(size.j, 0.0),
                                std::vector<double>(size.k, 0.0)},
                               0.0,
                               0.0};
    // The projections along x and along y; each plane k writes its own row of them.
    std::vector<double> alongX(std::size_t(size.j) * size.k, 0.0);
    std::vector<double> alongY(std::size_t(size.i) * size.k, 0.0);
    const volume::Lattice &places = field.lattice();
    const glm::dvec3 center = places.center().mm;
    EnergyMarginals sums = field.visit([&](auto samples) {
        return tbb::parallel_deterministic_reduce(
            tbb::blocked_range<int>(0, size.k, 8), zero,
            [&](const tbb::blocked_range<int> &range, EnergyMarginals sum) {
                for (int k = range.begin(); k != range.end(); ++k)
                    for (int j = 0; j < size.j; ++j) {
                        const std::size_t row =
                            (std::size_t(k + box.lo.k) * lattice.j + j + box.lo.j) * lattice.i +
                            box.lo.i;
                        double inRow = 0.0, rowSum = 0.0;
                        int first = size.i, last = -1;
                        for (int i = 0; i < size.i; ++i) {
                            const double f = double(samples[row + i]);
                            sum.axis[0][i] += f * f;
                            inRow += f * f;
                            rowSum += f;
                            alongY[std::size_t(k) * size.i + i] += f;
                            if (f != 0.0) {
                                first = std::min(first, i);
                                last = i;
                            }
                        }
                        for (const int end : {first, last})
                            if (last >= 0) {
                                const volume::VoxelIndex at{end + box.lo.i, j + box.lo.j,
                                                            k + box.lo.k};
                                sum.radiusMm = std::max(
                                    sum.radiusMm, glm::distance(center, places.patient(at).mm));
                            }
                        alongX[std::size_t(k) * size.j + j] = rowSum;
                        sum.axis[1][j] += inRow;
                        sum.axis[2][k] += inRow;
                    }
                return sum;
            },
            [](EnergyMarginals a, const EnergyMarginals &b) {
                for (int d = 0; d < 3; ++d)
                    std::transform(a.axis[d].begin(), a.axis[d].end(), b.axis[d].begin(),
                                   a.axis[d].begin(), std::plus<>());
                a.radiusMm = std::max(a.radiusMm, b.radiusMm);
                return a;
            });
    });
    double total = 0.0;
    for (const double e : sums.axis[2])
        total += e;
    std::vector<double> alongZ(std::size_t(size.i) * size.j, 0.0);
    field.visit([&](auto samples) {
        tbb::parallel_for(0, size.j, [&](int j) {
            for (int k = 0; k < size.k; ++k)
                for (int i = 0; i < size.i; ++i)
                    alongZ[std::size_t(j) * size.i + i] += double(
                        samples[(std::size_t(k + box.lo.k) * lattice.j + j + box.lo.j) * lattice.i +
                                box.lo.i + i]);
        });
    });
    sums.roughness = std::max({roughness(alongX, size.j, size.k), roughness(alongY, size.i, size.k),
                               roughness(alongZ, size.i, size.j)});
    if (total > 0.0)
        for (auto &axis : sums.axis)
            for (double &e : axis)
                e /= total;
    return sums;
}

double ringingPixels(double rollOff) {
    return 4.0 / std::max(1.0 / 64.0, rollOff);
}

double predictFoldedTails(const ImageDefinition &image, const Camera &camera, int columns, int rows,
                          const EnergyMarginals &energy, const volume::Lattice &lattice,
                          const volume::VoxelBox &box) {
    const auto tailEnergy = [&](double pixels) {
        const double r = std::max(1.0, pixels);
        const double rolled = std::min(1.0, 0.3 / (std::max(image.rollOff, 1e-6) * r));
        return 2.0 / (std::numbers::pi * std::numbers::pi * r) * std::pow(rolled, 4);
    };
    const glm::dvec2 pan = glm::abs(camera.panMm) / camera.pixelMm;
    const std::array<int, 3> first{box.lo.i, box.lo.j, box.lo.k};
    double most = 0.0;
    for (int d = 0; d < 3; ++d) {
        const std::vector<double> &along = energy.axis[d];
        double sum = 0.0;
        for (std::size_t n = 0; n < along.size(); ++n) {
            // Seen obliquely, what lies off two axes lies further out than on one.
            const double x = 1.2 * std::abs(first[d] + double(n) - 0.5 * (lattice.size()[d] - 1)) *
                             lattice.spacingMm(d) / camera.pixelMm;
            // Copies come from both sides along both directions.
            const double u = columns - 0.5 * camera.width - pan.x;
            const double v = rows - 0.5 * camera.height - pan.y;
            sum += along[n] * 0.5 *
                   (tailEnergy(u - x) + tailEnergy(u + x) + tailEnergy(v - x) + tailEnergy(v + x));
        }
        most = std::max(most, sum);
    }
    return std::sqrt(fewMargin * most * energy.roughness);
}

AxisError axisError(const fourier::Kernel &kernel, int padded, const std::vector<double> &energy) {
    // The amplitudes change slowly: some forty positions an axis are enough.
    const int samples = int(energy.size()), bins = std::min(samples, 40);
    double ghosts = 0.0, inPhase = 0.0, inverse = 0.0, mostEnergy = 0.0, brightest = 0.0;
    for (const double e : energy)
        mostEnergy = std::max(mostEnergy, e);
    for (int bin = 0; bin < bins; ++bin) {
        const int first = bin * samples / bins, last = (bin + 1) * samples / bins;
        double e = 0.0, moment = 0.0, here = 0.0;
        for (int n = first; n < last; ++n) {
            here = std::max(here, energy[n]);
            e += energy[n];
            moment += energy[n] * (n - samples / 2);
        }
        if (e == 0.0)
            continue;
        const double x = moment / e / padded;
        const double h = kernel.apodisation(x);
        // The kernels' transforms fall at least as 1/m beyond.
        double squares = 0.0;
        for (const int m : {-3, -2, -1, 1, 2, 3}) {
            const double r = kernel.apodisation(x + m) / h;
            squares += r * r;
        }
        ghosts += e * squares;
        const int width = kernel.width(), firstTap = -(width / 2);
        std::complex<double> onGrid = 0.0;
        for (int tap = firstTap; tap < firstTap + width; ++tap)
            onGrid += kernel.value(tap) * std::polar(1.0, 2.0 * std::numbers::pi * tap * x);
        inPhase += e * std::norm(onGrid / h - 1.0);
        brightest = std::max(brightest, std::sqrt(squares * here / mostEnergy));
        inverse += e / (h * h);
    }
    // Cells of a few samples' spectrum are alike and round alike: nothing averages out.
    const double noise = samples <= 4 ? 1.0 : kernel.energy() * inverse;
    return {ghosts, inPhase, brightest, noise};
}

// A rounding error is evenly spread up to half a unit in the last place, 2^-11 of the leading power
// of two; over the mantissas that is 0.73 * 2^-11/sqrt(3).
static double relativeRounding(fourier::Storage storage) {
    return storage == fourier::Storage::binary16 ? 2.1e-4 : 3e-7;
}

double predictMaximum(const std::array<AxisError, 3> &axes, fourier::Storage storage) {
    double ghosts = 0.0, noise = 1.0;
    for (const AxisError &axis : axes) {
        ghosts += axis.brightest;
        noise *= axis.noise;
    }
    const double rounding = relativeRounding(storage);
    return ghosts + 4.5 * std::sqrt(0.2 * rounding * rounding * noise);
}

double predictRelativeError(const std::array<AxisError, 3> &axes, fourier::Storage storage,
                            const ImageShare &share) {
    double all = 0.0, alongAxis = 0.0, noise = 1.0;
    for (int d = 0; d < 3; ++d) {
        all += share.inImage[d] * axes[d].ghosts;
        noise *= axes[d].noise;
    }
    for (int d = 0; d < 3; ++d)
        alongAxis = std::max(alongAxis, std::max(axes[d].ghosts, axes[d].inPhase) + all -
                                            share.inImage[d] * axes[d].ghosts);
    const double ghosts = viewMargin * alongAxis;
    const double rounding = relativeRounding(storage);
    // Rounding is spread as h^2 is, nearly all of it where the field is.
    return std::sqrt(ghosts + fewMargin * rounding * rounding * noise);
}

} // namespace pellucid::render
