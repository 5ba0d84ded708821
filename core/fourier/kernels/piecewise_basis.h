// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/fourier/kernels/piecewise_kernel.h"

namespace pellucid::fourier {

/// The piecewise polynomials of one width, degree and parity, for least-squares fits of kernels.
/// The taps left of the middle have every Legendre polynomial, the middle tap has those of the
/// parity, and the taps right of it mirror the left. Taps and offsets are those of `Kernel`.
///
/// The aliases of the widest kernels are 1e-7 of the image, so their energy is 1e-14 of the
/// kernel's: double precision cannot distinguish it from rounding.
class PiecewiseBasis {
public:
    using Real = long double;
    using Vector = std::vector<Real>;

    PiecewiseBasis(int width, int degree, Parity parity);

    std::size_t count() const { return m_at.size(); }
    /// The transform of each coefficient's part of the kernel at x: the integral of the part times
    /// cos(2 pi t x), or times sin if the parity is odd. *Units*: x in periods.
    Vector transforms(Real x) const;
    /// The same at x + m for m from -farthest to farthest. *Shape*: [m + farthest].
    std::vector<Vector> transforms(Real x, int farthest) const;
    /// The sum of exp(i 2 pi t x) times each coefficient's part over the taps that a frequency at
    /// offset c reads: real and imaginary part. At c = -1/2 the first tap is on the edge and has no
    /// partner.
    std::pair<Vector, Vector> transformsAt(Real c, Real x) const;
    /// The kernel that has these coefficients. *Shape*: by tap, ascending powers of c.
    std::vector<std::vector<double>> pieces(const Vector &coefficients) const;

private:
    int m_width, m_degree;
    Parity m_parity;
    std::vector<std::pair<int, int>> m_at; // tap, Legendre degree
};

/// The offsets c of a frequency on the grid: at -1/2 the first tap of an even width is on the edge,
/// and so is that of an odd width where the frequency is between two cells.
std::vector<PiecewiseBasis::Real> offsetsOnGrid(int width);
/// The padding that kernels are fitted for: that of the axis, rounded down to eighths, so that the
/// axes of all volumes share a few kernels; from 1.05, where a field leaves some margin, to 4, the
/// most that a scene may ask for.
double fittedPadding(double padding);

/// A least-squares fit of the coefficients of a basis.
class BasisFit {
public:
    explicit BasisFit(std::size_t count);
    /// Adds weight (part . a - target)^2 to the sum that the coefficients a minimise.
    void add(const PiecewiseBasis::Vector &part, PiecewiseBasis::Real target,
             PiecewiseBasis::Real weight);
    PiecewiseBasis::Vector solved() const;

private:
    std::vector<PiecewiseBasis::Vector> m_matrix;
    PiecewiseBasis::Vector m_right;
};

/// Solves a x = b for a symmetric positive definite a. *Shape*: only the upper half of a is read.
///
/// Not Eigen's `ldlt`: it eliminates in a different order, and the systems of widths 6 and 7 are so
/// badly conditioned that 258 of 9,408 float coefficients change, by up to 1e-5, and pictures with
/// them; this file would take 3.0 s to compile instead of 0.8 s.
PiecewiseBasis::Vector solveSymmetric(std::vector<PiecewiseBasis::Vector> a,
                                      PiecewiseBasis::Vector b);

} // namespace pellucid::fourier
