// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/fourier/kernel.h"
#include "core/fourier/quadrature.h"

namespace pellucid::fourier {

namespace {

// The ghosts of the widest kernels are 1e-7 of the image, so their energy is 1e-14 of the kernel's:
// double precision cannot tell them from rounding.
using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;
using Vector = std::vector<Real>;

// cos(2 pi turns); beyond an eighth of a turn the library's own reduction takes most of the time.
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

// Legendre polynomials on [-1/2, 1/2] keep the system well conditioned.
Vector legendre(int degree, Real c) {
    Vector p(std::size_t(degree) + 1, 1);
    if (degree > 0)
        p[1] = 2 * c;
    for (int n = 2; n <= degree; ++n)
        p[n] = ((2 * n - 1) * 2 * c * p[n - 1] - (n - 1) * p[n - 2]) / n;
    return p;
}

// Gaussian elimination of a symmetric positive matrix, of which the upper half is given: it needs
// no pivoting and stays symmetric.
Vector solve(std::vector<Vector> a, Vector right) {
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

Real dot(const Vector &a, const Vector &b) {
    Real sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        sum += a[n] * b[n];
    return sum;
}

// The kernel's free coefficients: every Legendre polynomial of the taps left of the middle, the
// even ones of the middle tap; the taps right of it mirror.
struct Coefficients {
    int width, degree;
    std::vector<std::pair<int, int>> at; // tap, Legendre degree
    Coefficients(int w, int d) : width(w), degree(d) {
        for (int k = 0; k < (w + 1) / 2; ++k)
            for (int n = 0; n <= d; n += 2 * k == w - 1 ? 2 : 1)
                at.emplace_back(k, n);
    }
    // The transform of every coefficient's part of the kernel at x (in periods).
    Vector transforms(Real x) const {
        static const GaussLegendre<Real> quadrature(20);
        static const std::vector<Vector> polynomials = [] {
            std::vector<Vector> values;
            for (const Real c : quadrature.at)
                values.push_back(legendre(Kernel::largestWidth, c));
            return values;
        }();
        std::vector<Vector> sums((width + 1) / 2, Vector(std::size_t(degree) + 1, 0));
        for (std::size_t g = 0; g < quadrature.at.size(); ++g) {
            const Vector &p = polynomials[g];
            for (std::size_t k = 0; k < sums.size(); ++k) {
                const Real t = Real(k) - Real(width - 1) / 2 + quadrature.at[g];
                const Real wave = quadrature.weight[g] * cosOfTurns(t * x);
                for (int n = 0; n <= degree; ++n)
                    sums[k][n] += wave * p[n];
            }
        }
        Vector result;
        for (const auto &[k, n] : at)
            result.push_back((2 * k == width - 1 ? 1 : 2) * sums[k][n]);
        return result;
    }
    // The transform of every coefficient's part of the taps that a frequency at offset c reads,
    // real and imaginary part. At c = -1/2 the first tap lies on the edge and has no partner.
    std::pair<Vector, Vector> transformsAt(Real c, Real x) const {
        const Vector p = legendre(degree, c), mirrored = legendre(degree, -c);
        Vector real, imaginary;
        for (const auto &[k, n] : at) {
            const Real t = c + Real(k) - Real(width - 1) / 2;
            const Real other = c + Real(width - 1 - k) - Real(width - 1) / 2;
            real.push_back(p[n] * cosOfTurns(t * x));
            imaginary.push_back(p[n] * sinOfTurns(t * x));
            if (2 * k == width - 1)
                continue;
            real.back() += mirrored[n] * cosOfTurns(other * x);
            imaginary.back() += mirrored[n] * sinOfTurns(other * x);
        }
        return {real, imaginary};
    }
};

// Monomials in c of a Legendre series on [-1/2, 1/2].
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

// What is minimised is J(a) = sum_x e(x) g(x) / h(x)^2 with h = b_0.a and g the sum of the squares
// of b_m.a over the ghosts m, and of what they add up to for a frequency on the grid. There, in
// views along an axis, they are in phase: the kernel of width 4 that only spared them one by one
// had 2.6 times the error in these views, which are the standard ones. The gradient vanishes where
//   [sum_x e/h^2 sum_m b_m b_m^T] a = sum_x e g/h^3 b_0,
// which a few rounds of solving for a with g and h of the round before reach.
Vector leastGhostCoefficients(const Coefficients &kernel, double padding,
                              std::span<const double> energy) {
    const int width = kernel.width;
    constexpr int positions = 32, farthest = 5, rounds = 16;
    constexpr Real settled = 1e-8; // of coefficients up to 1: the ghosts change by its square
    const std::size_t count = kernel.at.size();
    Vector e(positions, 1 / Real(positions));
    if (!energy.empty()) {
        Real total = 0;
        Vector spread(positions, 0);
        for (std::size_t n = 0; n < energy.size(); ++n) {
            spread[n * positions / energy.size()] += energy[n];
            total += energy[n];
        }
        for (int i = 0; i < positions && total > 0; ++i)
            e[i] = (e[i] + spread[i] / total) / 2;
    }
    std::vector<Vector> direct(positions);
    std::vector<std::vector<Vector>> ghosts(positions);
    std::vector<std::vector<Vector>> squares(positions,
                                             std::vector<Vector>(count, Vector(count, 0)));
    tbb::parallel_for(0, positions, [&](int i) {
        const Real x = (i + Real(0.5)) / positions / (2 * Real(padding));
        direct[i] = kernel.transforms(x);
        for (int m = -farthest; m <= farthest; ++m)
            if (m != 0)
                ghosts[i].push_back(kernel.transforms(x + m));
        for (const Real c : width % 2 == 0 ? std::vector<Real>{-0.5} : std::vector<Real>{-0.5, 0}) {
            auto [real, imaginary] = kernel.transformsAt(c, x);
            for (std::size_t p = 0; p < count; ++p)
                real[p] -= direct[i][p];
            ghosts[i].push_back(std::move(real));
            ghosts[i].push_back(std::move(imaginary));
        }
        for (const Vector &b : ghosts[i])
            for (std::size_t p = 0; p < count; ++p)
                for (std::size_t q = p; q < count; ++q)
                    squares[i][p][q] += b[p] * b[q];
    });
    Vector a(count, 0), h(positions, 1), g(positions, 1);
    const Vector middle = kernel.transforms(0);
    for (int round = 0; round < rounds; ++round) {
        std::vector<Vector> matrix(count, Vector(count, 0));
        Vector right(count, 0);
        for (int i = 0; i < positions; ++i) {
            const Real weight = e[i] / (h[i] * h[i]);
            for (std::size_t p = 0; p < count; ++p) {
                for (std::size_t q = p; q < count; ++q)
                    matrix[p][q] += weight * squares[i][p][q];
                right[p] += weight * g[i] / h[i] * direct[i][p];
            }
        }
        for (std::size_t p = 0; p < count; ++p)
            matrix[p][p] += Real(1e-19); // far below the ghosts of any width
        const Vector before = std::exchange(a, solve(std::move(matrix), std::move(right)));
        const Real scale = 1 / dot(a, middle);
        for (Real &value : a)
            value *= scale;
        Real change = 0;
        for (std::size_t p = 0; p < count; ++p)
            change = std::max(change, std::abs(a[p] - before[p]));
        if (change < settled)
            break;
        for (int i = 0; i < positions; ++i) {
            h[i] = dot(a, direct[i]);
            g[i] = 0;
            for (const Vector &b : ghosts[i]) {
                const Real ghost = dot(a, b);
                g[i] += ghost * ghost;
            }
        }
    }
    return a;
}

} // namespace

Kernel Kernel::leastGhosts(int width, double padding, std::span<const double> energy) {
    assert(width >= 2 && width <= largestWidth && padding > 1.0);
    // Below this degree the error doubles and more; one degree above gains under a hundredth.
    const int degree = std::max(3, width);
    const Coefficients kernel(width, degree);
    const Vector a = leastGhostCoefficients(kernel, padding, energy);
    std::vector<Vector> series((width + 1) / 2, Vector(std::size_t(degree) + 1, 0));
    for (std::size_t n = 0; n < a.size(); ++n)
        series[kernel.at[n].first][kernel.at[n].second] = a[n];
    std::vector<std::vector<double>> pieces(width);
    for (int k = 0; k < (width + 1) / 2; ++k) {
        pieces[k] = monomials(series[k]);
        pieces[width - 1 - k] = pieces[k];
        for (int n = 1; n <= degree; n += 2)
            pieces[width - 1 - k][n] = -pieces[k][n];
    }
    // The middle tap of an odd width is even: its odd coefficients are zero already.
    return Kernel("LS" + std::to_string(width), width, std::move(pieces));
}

} // namespace pellucid::fourier
