// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fourier/kernel.h"

namespace pellucid::fourier {

/// The odd kernel that reads from a spectrum prepared for a `Kernel` not the field but the field
/// times its distance from the wrap voxel, along one axis: the derivative of the spectrum. Of the
/// odd piecewise polynomials of the kernel's width and of degree max(3, width), the one that comes
/// closest to x h(x) over the field with the least ghosts, by least squares; the derivative of the
/// kernel itself, which the source takes, has exactly x h(x) and (x + m) h(x + m) for its ghosts,
/// and deltas where the kernel jumps.
/// *Source*: Totsuka 1993, eq. 4 and 5, the filter of V . grad H.
class MomentKernel {
public:
    /// `padding`: of the axis; the field ends at 1/(2 padding) of the period.
    MomentKernel(const Kernel &kernel, double padding);

    int width() const { return m_width; }
    /// K(t), odd; zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const;
    /// k(x) = integral of K(t) sin(2 pi t x) dt, nearly x h(x). *Units*: x in padded periods.
    double response(double x) const;

    /// The weights of all taps by symmetry, as of `Kernel`: tap k weighs e + c o and tap width-1-k
    /// weighs c o - e; the middle tap c o.
    int terms() const { return m_terms; }
    const std::vector<float> &pairs() const { return m_pairs; }

private:
    int m_width, m_terms;
    std::vector<std::vector<double>> m_pieces; // ascending powers of c, by tap
    std::vector<float> m_pairs;
    std::vector<double> m_nodes, m_weighted; // of a quadrature, as of Kernel
};

} // namespace pellucid::fourier
