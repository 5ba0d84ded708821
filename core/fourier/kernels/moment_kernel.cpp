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
    const std::size_t count = basis.count();
    std::vector<Vector> matrix(count, Vector(count, 0));
    Vector right(count, 0);
    for (int i = 0; i < positions; ++i) {
        const Real x = (i + Real(0.5)) / positions / (2 * Real(padding));
        const Real h = kernel.apodisation(double(x)), weight = 1 / (h * h);
        const auto add = [&](const Vector &part, Real target) {
            for (std::size_t p = 0; p < count; ++p) {
                for (std::size_t q = p; q < count; ++q)
                    matrix[p][q] += weight * part[p] * part[q];
                right[p] += weight * target * part[p];
            }
        };
        add(basis.transforms(x), x * h);
        for (int m = -farthest; m <= farthest; ++m)
            if (m != 0)
                add(basis.transforms(x + m), 0);
        for (const Real c :
             kernel.width() % 2 == 0 ? std::vector<Real>{-0.5} : std::vector<Real>{-0.5, 0}) {
            const auto [real, imaginary] = basis.transformsAt(c, x);
            add(real, 0);
            add(imaginary, x * h);
        }
    }
    for (std::size_t p = 0; p < count; ++p)
        matrix[p][p] += Real(1e-19); // far below the aliases of any width
    return solveSymmetric(std::move(matrix), std::move(right));
}

PiecewiseKernel momentKernel(const Kernel &kernel, double padding) {
    const PiecewiseBasis basis(kernel.width(), std::max(3, kernel.width()), Parity::odd);
    // Short axes are padded more than necessary.
    const Vector best = coefficientsFor(basis, kernel, std::clamp(padding, 1.0, 2.5));
    return {basis.pieces(best), Parity::odd};
}

} // namespace

MomentKernel::MomentKernel(const Kernel &kernel, double padding)
    : m_shape(momentKernel(kernel, padding)) {}

} // namespace pellucid::fourier
