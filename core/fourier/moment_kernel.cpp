// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/moment_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fourier/piecewise_basis.h"
#include "core/fourier/quadrature.h"

namespace pellucid::fourier {

namespace {

using Real = PiecewiseBasis::Real;
using Vector = PiecewiseBasis::Vector;

// What is minimised, linear in the coefficients, is
//   sum_x 1/h(x)^2 [(k(x) - x h(x))^2 + sum_m k(x + m)^2 + |S(x) - i x h(x)|^2],
// m the ghosts and S what the taps of a frequency on the grid give, where the ghosts are in phase.
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
        matrix[p][p] += Real(1e-19); // far below the ghosts of any width
    return solveSymmetric(std::move(matrix), std::move(right));
}

double horner(const std::vector<double> &p, double c) {
    double sum = 0.0;
    for (auto it = p.rbegin(); it != p.rend(); ++it)
        sum = sum * c + *it;
    return sum;
}

} // namespace

MomentKernel::MomentKernel(const Kernel &kernel, double padding) : m_width(kernel.width()) {
    const int degree = std::max(3, m_width);
    const PiecewiseBasis basis(m_width, degree, Parity::odd);
    // Short axes are padded to more than they need.
    m_pieces = basis.pieces(coefficientsFor(basis, kernel, std::clamp(padding, 1.0, 2.5)));
    m_terms = (degree + 2) / 2;
    for (int k = 0; k < (m_width + 1) / 2; ++k)
        for (const std::size_t parity : {std::size_t(0), std::size_t(1)})
            for (int n = 0; n < m_terms; ++n) {
                const std::size_t power = 2 * std::size_t(n) + parity;
                m_pairs.push_back(power < m_pieces[k].size() ? float(m_pieces[k][power]) : 0.0F);
            }
    static const GaussLegendre<double> quadrature(16);
    for (int k = 0; k < m_width; ++k)
        for (std::size_t n = 0; n < quadrature.at.size(); ++n) {
            m_nodes.push_back(2.0 * std::numbers::pi *
                              (k - 0.5 * (m_width - 1) + quadrature.at[n]));
            m_weighted.push_back(quadrature.weight[n] * horner(m_pieces[k], quadrature.at[n]));
        }
}

double MomentKernel::value(double t) const {
    const double half = 0.5 * m_width;
    if (std::abs(t) > half)
        return 0.0;
    const int k = std::min(m_width - 1, int(std::floor(t + half)));
    return horner(m_pieces[k], t - (k - 0.5 * (m_width - 1)));
}

double MomentKernel::response(double x) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < m_nodes.size(); ++n)
        sum += m_weighted[n] * std::sin(m_nodes[n] * x);
    return sum;
}

} // namespace pellucid::fourier
