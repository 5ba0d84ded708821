// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/fourier/kernels/piecewise_kernel.h"

namespace pellucid::fourier {

/// The piecewise polynomials of one width, degree and parity, for fits of kernels by least squares:
/// every Legendre polynomial of the taps left of the middle, those of the parity of the middle tap;
/// the taps right of it mirror. Taps and offsets are those of `Kernel`.
///
/// The aliases of the widest kernels are 1e-7 of the image, so their energy is 1e-14 of the
/// kernel's: double precision cannot tell them from rounding.
class PiecewiseBasis {
public:
    using Real = long double;
    using Vector = std::vector<Real>;

    PiecewiseBasis(int width, int degree, Parity parity);

    std::size_t count() const { return m_at.size(); }
    /// The transform of every coefficient's part of the kernel at x (in periods): integral of the
    /// part times cos(2 pi t x), or times sin for odd ones.
    Vector transforms(Real x) const;
    /// The sum of exp(i 2 pi t x) times every coefficient's part over the taps that a frequency at
    /// offset c reads, real and imaginary part. At c = -1/2 the first tap lies on the edge and has
    /// no partner.
    std::pair<Vector, Vector> transformsAt(Real c, Real x) const;
    /// The kernel of coefficients: ascending powers of c, by tap.
    std::vector<std::vector<double>> pieces(const Vector &coefficients) const;

private:
    int m_width, m_degree;
    Parity m_parity;
    std::vector<std::pair<int, int>> m_at; // tap, Legendre degree
};

/// The weights a and right hand sides b of a symmetric positive system, of whose matrix the upper
/// half is given, solved for x in a x = b.
PiecewiseBasis::Vector solveSymmetric(std::vector<PiecewiseBasis::Vector> a,
                                      PiecewiseBasis::Vector b);

} // namespace pellucid::fourier
