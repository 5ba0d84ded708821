// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels/moment_kernel.h"

#include <algorithm>

#include "core/fourier/kernels/piecewise_basis.h"

namespace pellucid::fourier {

namespace {

using Real = PiecewiseBasis::Real;
using Vector = PiecewiseBasis::Vector;

// Minimises, by linear least squares,
//   sum_x 1/h(x)^2 [(k(x) - x h(x))^2 + sum_m k(x + m)^2 + |S(x) - i x h(x)|^2].
// m are the aliases; S is the sum over the taps of a frequency on the grid, where the aliases are
// in phase.
Vector coefficientsFor(const PiecewiseBasis &basis, const Kernel &kernel, double padding) {
    constexpr int positions = 24, farthest = 4;
    BasisFit fit(basis.count());
    for (int i = 0; i < positions; ++i) {
        const Real x = (i + Real(0.5)) / positions / (2 * Real(padding));
        const Real h = kernel.apodisation(double(x)), weight = 1 / (h * h);
        const std::vector<Vector> near = basis.transforms(x, farthest);
        for (int m = -farthest; m <= farthest; ++m)
            fit.add(near[std::size_t(m + farthest)], m == 0 ? x * h : 0, weight);
        for (const Real c : offsetsOnGrid(kernel.width())) {
            const auto [real, imaginary] = basis.transformsAt(c, x);
            fit.add(real, 0, weight);
            fit.add(imaginary, x * h, weight);
        }
    }
    return fit.solved();
}

PiecewiseKernel momentKernel(const Kernel &kernel, double padding) {
    const PiecewiseBasis basis(kernel.width(), std::max(3, kernel.width()), Parity::odd);
    const Vector best = coefficientsFor(basis, kernel, fittedPadding(padding));
    return {basis.pieces(best), Parity::odd};
}

} // namespace

MomentKernel::MomentKernel(const Kernel &kernel, double padding)
    : m_shape(momentKernel(kernel, padding)) {}

} // namespace pellucid::fourier
