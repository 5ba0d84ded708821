// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/kernels/piecewise_basis.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/fourier/kernels/kernel.h"
#include "core/fourier/kernels/quadrature.h"

namespace pellucid::fourier {

namespace {

using Real = PiecewiseBasis::Real;
using Vector = PiecewiseBasis::Vector;
constexpr Real pi = std::numbers::pi_v<Real>;

// cos(2 pi turns). Beyond an eighth of a turn, argument reduction in the standard library would
// take most of the time.
Real cosOfTurns(Real turns) {
    turns = std::abs(turns - std::round(turns));
    const bool negative = turns > 0.25L;
    if (negative)
        turns = 0.5L - turns;
    const Real value =
        turns > 0.125L ? std::sin(2 * pi * (0.25L - turns)) : std::cos(2 * pi * turns);
    return negative ? -value : value;
}
Real sinOfTurns(Real turns) {
    return cosOfTurns(turns - 0.25L);
}

// Legendre polynomials on [-1/2, 1/2] keep the system well conditioned. Boost.Math's
// `legendre_next` gives the same bits, but it replaces only the line in the loop, and this file
// would take 1.6 s to compile instead of 0.8 s.
Vector legendre(int degree, Real c) {
    Vector p(std::size_t(degree) + 1, 1);
    if (degree > 0)
        p[1] = 2 * c;
    for (int n = 2; n <= degree; ++n)
        p[n] = ((2 * n - 1) * 2 * c * p[n - 1] - (n - 1) * p[n - 2]) / n;
    return p;
}

// The monomial coefficients in c of a Legendre series on [-1/2, 1/2].
std::vector<double> monomials(const Vector &series) {
    const int count = int(series.size());
    std::vector<Vector> p(count, Vector(count, 0));
    p[0][0] = 1;
    if (count > 1)
        p[1][1] = 2;
    for (int n = 2; n < count; ++n)
        for (int m = 0; m < count; ++m)
            p[n][m] = ((2 * n - 1) * 2 * (m > 0 ? p[n - 1][m - 1] : 0) - (n - 1) * p[n - 2][m]) / n;
    std::vector<double> result(count);
    for (int m = 0; m < count; ++m) {
        Real sum = 0;
        for (int n = 0; n < count; ++n)
            sum += series[n] * p[n][m];
        result[m] = double(sum);
    }
    return result;
}

// A kernel's value at the mirror image of a tap, divided by its value at the tap.
Real mirrorSign(Parity parity) {
    return parity == Parity::even ? 1 : -1;
}

} // namespace

PiecewiseBasis::PiecewiseBasis(int width, int degree, Parity parity)
    : m_width(width), m_degree(degree), m_parity(parity) {
    for (int k = 0; k < (width + 1) / 2; ++k) {
        const bool middle = 2 * k == width - 1;
        for (int n = middle && parity == Parity::odd ? 1 : 0; n <= degree; n += middle ? 2 : 1)
            m_at.emplace_back(k, n);
    }
}

std::vector<Vector> PiecewiseBasis::transforms(Real x, int farthest) const {
    static const GaussLegendre<Real> quadrature(20);
    static const std::vector<Vector> polynomials = [] {
        std::vector<Vector> values;
        for (const Real c : quadrature.at)
            values.push_back(legendre(Kernel::largestWidth, c));
        return values;
    }();
    const auto waveAt = [](Real turns) {
        return std::complex<Real>(cosOfTurns(turns), sinOfTurns(turns));
    };
    std::vector<Vector> all(std::size_t(2 * farthest + 1), Vector(m_at.size(), 0));
    std::vector<Vector> sums(all.size(), Vector(std::size_t(m_degree) + 1, 0));
    for (int k = 0; k < (m_width + 1) / 2; ++k) {
        for (Vector &sum : sums)
            std::fill(sum.begin(), sum.end(), 0);
        for (std::size_t g = 0; g < quadrature.at.size(); ++g) {
            const Vector &p = polynomials[g];
            const Real t = Real(k) - Real(m_width - 1) / 2 + quadrature.at[g];
            // From one alias to the next the wave turns by t.
            const std::complex<Real> turn = waveAt(t);
            std::complex<Real> wave = quadrature.weight[g] * waveAt(t * (x - Real(farthest)));
            for (Vector &sum : sums) {
                const Real value = m_parity == Parity::even ? wave.real() : wave.imag();
                for (int n = 0; n <= m_degree; ++n)
                    sum[n] += value * p[n];
                wave = {wave.real() * turn.real() - wave.imag() * turn.imag(),
                        wave.real() * turn.imag() + wave.imag() * turn.real()};
            }
        }
        const Real sides = 2 * k == m_width - 1 ? 1 : 2;
        for (std::size_t n = 0; n < m_at.size(); ++n)
            if (m_at[n].first == k)
                for (std::size_t m = 0; m < all.size(); ++m)
                    all[m][n] = sides * sums[m][std::size_t(m_at[n].second)];
    }
    return all;
}

Vector PiecewiseBasis::transforms(Real x) const {
    return transforms(x, 0).front();
}

std::pair<Vector, Vector> PiecewiseBasis::transformsAt(Real c, Real x) const {
    const Vector p = legendre(m_degree, c), mirrored = legendre(m_degree, -c);
    Vector real, imaginary;
    for (const auto &[k, n] : m_at) {
        const Real t = c + Real(k) - Real(m_width - 1) / 2;
        const Real other = c + Real(m_width - 1 - k) - Real(m_width - 1) / 2;
        real.push_back(p[n] * cosOfTurns(t * x));
        imaginary.push_back(p[n] * sinOfTurns(t * x));
        if (2 * k == m_width - 1)
            continue;
        real.back() += mirrorSign(m_parity) * mirrored[n] * cosOfTurns(other * x);
        imaginary.back() += mirrorSign(m_parity) * mirrored[n] * sinOfTurns(other * x);
    }
    return {real, imaginary};
}

std::vector<std::vector<double>> PiecewiseBasis::pieces(const Vector &coefficients) const {
    std::vector<Vector> series((m_width + 1) / 2, Vector(std::size_t(m_degree) + 1, 0));
    for (std::size_t n = 0; n < coefficients.size(); ++n)
        series[m_at[n].first][m_at[n].second] = coefficients[n];
    std::vector<std::vector<double>> result(m_width);
    for (int k = 0; k < (m_width + 1) / 2; ++k) {
        result[k] = monomials(series[k]);
        if (2 * k == m_width - 1)
            continue; // it has the parity already
        result[m_width - 1 - k] = result[k];
        for (int n = m_parity == Parity::even ? 1 : 0; n <= m_degree; n += 2)
            result[m_width - 1 - k][n] = -result[k][n];
    }
    return result;
}

std::vector<Real> offsetsOnGrid(int width) {
    return width % 2 == 0 ? std::vector<Real>{-0.5} : std::vector<Real>{-0.5, 0};
}

double fittedPadding(double padding) {
    return std::clamp(std::floor(8.0 * padding) / 8.0, 1.05, 4.0);
}

BasisFit::BasisFit(std::size_t count) : m_matrix(count, Vector(count, 0)), m_right(count, 0) {}

void BasisFit::add(const Vector &part, Real target, Real weight) {
    for (std::size_t p = 0; p < part.size(); ++p) {
        for (std::size_t q = p; q < part.size(); ++q)
            m_matrix[p][q] += weight * part[p] * part[q];
        m_right[p] += weight * target * part[p];
    }
}

Vector BasisFit::solved() const {
    std::vector<Vector> matrix = m_matrix;
    for (std::size_t p = 0; p < matrix.size(); ++p)
        matrix[p][p] += Real(1e-19); // far below the aliases of any width
    return solveSymmetric(std::move(matrix), m_right);
}

// Gaussian elimination: a symmetric positive definite matrix needs no pivoting and stays symmetric.
Vector solveSymmetric(std::vector<Vector> a, Vector right) {
    const std::size_t n = right.size();
    for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = p + 1; q < n; ++q) {
            const Real factor = a[p][q] / a[p][p];
            for (std::size_t s = q; s < n; ++s)
                a[q][s] -= factor * a[p][s];
            right[q] -= factor * right[p];
        }
    for (std::size_t p = n; p-- > 0;) {
        for (std::size_t q = p + 1; q < n; ++q)
            right[p] -= a[p][q] * right[q];
        right[p] /= a[p][p];
    }
    return right;
}

} // namespace pellucid::fourier
