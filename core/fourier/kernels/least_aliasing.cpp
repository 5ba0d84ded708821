// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/fourier/kernels/kept_values.h"
#include "core/fourier/kernels/kernel.h"
#include "core/fourier/kernels/piecewise_basis.h"

namespace pellucid::fourier {

namespace {

using Real = PiecewiseBasis::Real;
using Vector = PiecewiseBasis::Vector;

Real dot(const Vector &a, const Vector &b) {
    Real sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        sum += a[n] * b[n];
    return sum;
}

// Sample positions from the wrap voxel to the edge of the field.
constexpr int positions = 32;

// What the pieces of a basis make of a sample at a position x.
struct Transforms {
    Vector direct;               ///< b_0
    std::vector<Vector> aliases; ///< b_m
    /// Real and imaginary part of a frequency on the grid, for each offset.
    std::vector<std::pair<Vector, Vector>> onGrid;
};

Real positionOf(int i, double padding) {
    return (i + Real(0.5)) / positions / (2 * Real(padding));
}

Transforms transformsAt(Real x, int width, const PiecewiseBasis &basis) {
    constexpr int farthest = 5;
    // x itself is in the middle.
    Transforms t{{}, basis.transforms(x, farthest), {}};
    t.direct = std::move(t.aliases[farthest]);
    t.aliases.erase(t.aliases.begin() + farthest);
    for (const Real c : offsetsOnGrid(width))
        t.onGrid.push_back(basis.transformsAt(c, x));
    return t;
}

using Table = std::vector<Transforms>;
using TableKey = std::pair<int, double>; // width and padding

// The transforms at all positions. The kernel of this width shares them with those that are
// narrower than another one.
const Table &tableOf(int width, const PiecewiseBasis &basis, double padding) {
    static KeptValues<TableKey, Table> tables;
    return tables.of({width, padding}, [&] {
        Table made(positions);
        tbb::parallel_for(0, positions, [&](int i) {
            made[std::size_t(i)] = transformsAt(positionOf(i, padding), width, basis);
        });
        return made;
    });
}

// The responses of the pieces of a basis to a sample at a position.
struct Responses {
    Vector direct;               ///< b_0
    std::vector<Vector> aliases; ///< b_m, and their sums for a frequency on the grid
    std::vector<Vector> squares; ///< the upper half of sum_m b_m b_m^T
};

Responses responsesOf(const Transforms &transforms) {
    const std::size_t count = transforms.direct.size();
    Responses r{transforms.direct, transforms.aliases,
                std::vector<Vector>(count, Vector(count, 0))};
    for (auto [real, imaginary] : transforms.onGrid) {
        for (std::size_t p = 0; p < count; ++p)
            real[p] -= r.direct[p];
        r.aliases.push_back(std::move(real));
        r.aliases.push_back(std::move(imaginary));
    }
    for (const Vector &b : r.aliases)
        for (std::size_t p = 0; p < count; ++p)
            for (std::size_t q = p; q < count; ++q)
                r.squares[p][q] += b[p] * b[q];
    return r;
}

// The coefficients a for given h and g at each position.
Vector solved(const std::vector<Responses> &responses, const Vector &h, const Vector &g) {
    const std::size_t count = responses.front().direct.size();
    std::vector<Vector> matrix(count, Vector(count, 0));
    Vector right(count, 0);
    for (int i = 0; i < positions; ++i) {
        const Responses &r = responses[i];
        const Real weight = 1 / (positions * h[i] * h[i]);
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t q = p; q < count; ++q)
                matrix[p][q] += weight * r.squares[p][q];
            right[p] += weight * g[i] / h[i] * r.direct[p];
        }
    }
    for (std::size_t p = 0; p < count; ++p)
        matrix[p][p] += Real(1e-19); // far below the aliases of any width
    return solveSymmetric(std::move(matrix), std::move(right));
}

// Minimises J(a) = sum_x g(x) / h(x)^2. h is b_0.a; g is the sum of the squares of b_m.a over
// the aliases m, and of their sum for a frequency on the grid. There, in views along an axis, the
// aliases are in phase: a kernel of width 4 that is optimised for single aliases only has 2.6 times
// the error in these views, which are the standard ones. The gradient vanishes where
//   [sum_x 1/h^2 sum_m b_m b_m^T] a = sum_x g/h^3 b_0.
// Solving for a with g and h of the previous round converges in a few rounds.
Vector leastAliasingCoefficients(int width, const PiecewiseBasis &kernel, double padding) {
    constexpr int rounds = 16;
    // Coefficients are at most 1, and the aliases change by the square of this.
    constexpr Real tolerance = 1e-8;
    std::vector<Responses> responses;
    for (const Transforms &transforms : tableOf(width, kernel, padding))
        responses.push_back(responsesOf(transforms));
    Vector a(kernel.count(), 0), h(positions, 1), g(positions, 1);
    const Vector middle = kernel.transforms(0);
    for (int round = 0; round < rounds; ++round) {
        const Vector before = std::exchange(a, solved(responses, h, g));
        const Real scale = 1 / dot(a, middle);
        for (Real &value : a)
            value *= scale;
        Real change = 0;
        for (std::size_t p = 0; p < a.size(); ++p)
            change = std::max(change, std::abs(a[p] - before[p]));
        if (change < tolerance)
            break;
        for (int i = 0; i < positions; ++i) {
            h[i] = dot(a, responses[i].direct);
            g[i] = 0;
            for (const Vector &b : responses[i].aliases) {
                const Real alias = dot(a, b);
                g[i] += alias * alias;
            }
        }
    }
    return a;
}

// Minimises, by linear least squares,
//   sum_x 1/h(x)^2 [(k(x) - h(x))^2 + sum_m k(x + m)^2 + |S(x) - h(x)|^2].
// m are the aliases; S is the sum over the taps of a frequency on the grid.
Vector narrowerCoefficients(int width, const PiecewiseBasis &basis, const Kernel &wide,
                            double padding) {
    const Table &table = tableOf(width, basis, padding);
    BasisFit fit(basis.count());
    for (int i = 0; i < positions; ++i) {
        const Transforms &t = table[std::size_t(i)];
        const Real h = wide.apodisation(double(positionOf(i, padding))), weight = 1 / (h * h);
        fit.add(t.direct, h, weight);
        for (const Vector &alias : t.aliases)
            fit.add(alias, 0, weight);
        for (const auto &[real, imaginary] : t.onGrid) {
            fit.add(real, h, weight);
            fit.add(imaginary, 0, weight);
        }
    }
    return fit.solved();
}

} // namespace

Kernel Kernel::narrower(const Kernel &wide, int width, double padding) {
    assert(width >= 2 && width < wide.width());
    const PiecewiseBasis basis(width, std::max(3, width), Parity::even);
    const Vector a = narrowerCoefficients(width, basis, wide, fittedPadding(padding));
    return Kernel(wide.name() + " by " + std::to_string(width), basis.pieces(a));
}

Kernel Kernel::leastAliasing(int width, double padding) {
    assert(width >= 2 && width <= largestWidth && padding >= 1.0);
    static KeptValues<TableKey, Kernel> kernels;
    const double fitted = fittedPadding(padding);
    return kernels.of({width, fitted}, [&] {
        // One degree lower at least doubles the error; one degree higher gains less than 1 %.
        const int degree = std::max(3, width);
        const PiecewiseBasis kernel(width, degree, Parity::even);
        const Vector a = leastAliasingCoefficients(width, kernel, fitted);
        return Kernel("LS" + std::to_string(width), kernel.pieces(a));
    });
}

} // namespace pellucid::fourier
