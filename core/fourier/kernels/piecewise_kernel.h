// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace pellucid::fourier {

/// The symmetry of a kernel about its middle.
enum class Parity { even, odd };

/// A kernel of one parity that is a polynomial on every unit interval. Its taps are those of
/// `Kernel`.
class PiecewiseKernel {
public:
    /// *Shape*: by tap, ascending powers of the offset c in [-1/2, 1/2). *Requires*: the pieces
    /// have the parity.
    PiecewiseKernel(std::vector<std::vector<double>> pieces, Parity parity);

    int width() const { return int(m_pieces.size()); }
    /// Zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const;
    /// The integral of the kernel times cos(2 pi t x), or sin(2 pi t x) if it is odd. *Units*: x in
    /// periods.
    double transform(double x) const;
    /// The integral of its square.
    double energy() const { return m_energy; }

    /// The polynomials of the taps, split by symmetry into e and o, both polynomials in c^2: tap k
    /// has the weight e + c o, and tap width-1-k has e - c o, or c o - e if the kernel is odd.
    /// *Shape*: for k = 0..(width-1)/2, `terms()` coefficients of e, then of o, ascending.
    int terms() const { return m_terms; }
    const std::vector<float> &pairs() const { return m_pairs; }

private:
    Parity m_parity;
    int m_terms = 1;
    std::vector<std::vector<double>> m_pieces;
    std::vector<float> m_pairs;
    // A quadrature over the positive half: 2 pi times the nodes, and weights times the kernel
    // there.
    std::vector<double> m_nodes, m_weighted;
    double m_energy = 0.0;
};

} // namespace pellucid::fourier
