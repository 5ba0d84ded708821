// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cassert>
#include <cmath>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

#include <tbb/parallel_for.h>

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

// The energy at each position as a share of the total; half of it is distributed evenly. `energy`
// is that of `makeKernel`.
Vector energyByPosition(std::span<const double> energy) {
    Vector e(positions, 1 / Real(positions));
    if (energy.empty())
        return e;
    Real total = 0;
    Vector spread(positions, 0);
    for (std::size_t n = 0; n < energy.size(); ++n) {
        spread[n * positions / energy.size()] += energy[n];
        total += energy[n];
    }
    for (int i = 0; i < positions && total > 0; ++i)
        e[i] = (e[i] + spread[i] / total) / 2;
    return e;
}

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
    Transforms t{basis.transforms(x), {}, {}};
    for (int m = -farthest; m <= farthest; ++m)
        if (m != 0)
            t.aliases.push_back(basis.transforms(x + m));
    for (const Real c : offsetsOnGrid(width))
        t.onGrid.push_back(basis.transformsAt(c, x));
    return t;
}

using Table = std::shared_ptr<const std::vector<Transforms>>;

// The transforms at all positions. They do not depend on the field, so that volumes of one size
// share them: sines and cosines in extended precision take most of the time of a fit.
Table tableOf(int width, const PiecewiseBasis &basis, double padding) {
    constexpr std::size_t mostKept = 48; // half a megabyte or less each
    using Key = std::pair<int, double>;
    static std::mutex mutex;
    static std::list<std::pair<Key, Table>> kept; // the last used first
    const Key key{width, padding};
    const auto take = [&]() -> Table {
        const std::lock_guard lock(mutex);
        const auto known = std::find_if(kept.begin(), kept.end(),
                                        [&](const auto &one) { return one.first == key; });
        if (known == kept.end())
            return nullptr;
        kept.splice(kept.begin(), kept, known);
        return known->second;
    };
    if (Table known = take())
        return known;
    std::vector<Transforms> made(positions);
    tbb::parallel_for(0, positions, [&](int i) {
        made[std::size_t(i)] = transformsAt(positionOf(i, padding), width, basis);
    });
    const auto table = std::make_shared<const std::vector<Transforms>>(std::move(made));
    if (!take()) { // another thread may have been faster
        const std::lock_guard lock(mutex);
        kept.emplace_front(key, table);
        if (kept.size() > mostKept)
            kept.pop_back();
    }
    return table;
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
Vector solved(const std::vector<Responses> &responses, const Vector &energy, const Vector &h,
              const Vector &g) {
    const std::size_t count = responses.front().direct.size();
    std::vector<Vector> matrix(count, Vector(count, 0));
    Vector right(count, 0);
    for (int i = 0; i < positions; ++i) {
        const Responses &r = responses[i];
        const Real weight = energy[i] / (h[i] * h[i]);
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

// Minimises J(a) = sum_x e(x) g(x) / h(x)^2. h is b_0.a; g is the sum of the squares of b_m.a over
// the aliases m, and of their sum for a frequency on the grid. There, in views along an axis, the
// aliases are in phase: a kernel of width 4 that is optimised for single aliases only has 2.6 times
// the error in these views, which are the standard ones. The gradient vanishes where
//   [sum_x e/h^2 sum_m b_m b_m^T] a = sum_x e g/h^3 b_0.
// Solving for a with g and h of the previous round converges in a few rounds.
Vector leastAliasingCoefficients(int width, const PiecewiseBasis &kernel, double padding,
                                 std::span<const double> energy) {
    constexpr int rounds = 16;
    // Coefficients are at most 1, and the aliases change by the square of this.
    constexpr Real tolerance = 1e-8;
    const Vector e = energyByPosition(energy);
    const Table table = tableOf(width, kernel, padding);
    std::vector<Responses> responses;
    for (const Transforms &transforms : *table)
        responses.push_back(responsesOf(transforms));
    Vector a(kernel.count(), 0), h(positions, 1), g(positions, 1);
    const Vector middle = kernel.transforms(0);
    for (int round = 0; round < rounds; ++round) {
        const Vector before = std::exchange(a, solved(responses, e, h, g));
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
    const Table table = tableOf(width, basis, padding);
    BasisFit fit(basis.count());
    for (int i = 0; i < positions; ++i) {
        const Transforms &t = (*table)[std::size_t(i)];
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

Kernel Kernel::leastAliasing(int width, double padding, std::span<const double> energy) {
    assert(width >= 2 && width <= largestWidth && padding > 1.0);
    // One degree lower at least doubles the error; one degree higher gains less than 1 %.
    const int degree = std::max(3, width);
    const PiecewiseBasis kernel(width, degree, Parity::even);
    const Vector a = leastAliasingCoefficients(width, kernel, padding, energy);
    return Kernel("LS" + std::to_string(width), kernel.pieces(a));
}

} // namespace pellucid::fourier
