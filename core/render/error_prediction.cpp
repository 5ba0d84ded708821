// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace pellucid::render {

namespace {

// Single views scatter about what is expected; this much more energy than expected was the worst of
// the views of the fields in the bench's hard suite.
constexpr double viewMargin = 1.5;
// The same of rounding, which a few cells can decide.
constexpr double fewMargin = 3.0;

} // namespace

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
