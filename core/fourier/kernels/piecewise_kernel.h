// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace pellucid::fourier {

/// What a kernel is about its middle.
enum class Parity { even, odd };

/// A kernel that is a polynomial on every unit interval, of one parity. Its taps are those of
/// `Kernel`.
class PiecewiseKernel {
public:
    /// *Shape*: ascending powers of the offset c in [-1/2, 1/2), by tap; of the parity.
    PiecewiseKernel(std::vector<std::vector<double>> pieces, Parity parity);

    int width() const { return int(m_pieces.size()); }
    /// Zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const;
    /// The integral of the kernel times cos(2 pi t x), or sin for an odd one. *Units*: x in
    /// periods.
    double transform(double x) const;
    /// The integral of its square.
    double energy() const { return m_energy; }

    /// The polynomials of the taps by symmetry: with e and o those of tap k in c^2, tap k weighs
    /// e + c o and tap width-1-k weighs e - c o, or c o - e for an odd kernel. *Shape*: for
    /// k = 0..(width-1)/2: `terms()` coefficients of e, then of o, ascending.
    int terms() const { return m_terms; }
    const std::vector<float> &pairs() const { return m_pairs; }

private:
    Parity m_parity;
    int m_terms = 1;
    std::vector<std::vector<double>> m_pieces;
    std::vector<float> m_pairs;
    // The kernel at the nodes of a quadrature over its positive half, times the weights.
    std::vector<double> m_nodes, m_weighted;
    double m_energy = 0.0;
};

} // namespace pellucid::fourier
