// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fourier/kernels/kernel.h"
#include "core/fourier/kernels/piecewise_kernel.h"

namespace pellucid::fourier {

/// The odd kernel that reads from a spectrum prepared for a `Kernel` not the field but the field
/// times its distance from the wrap voxel, along one axis: the derivative of the spectrum. Of the
/// odd piecewise polynomials of the kernel's width and of degree max(3, width), the one that comes
/// closest to x h(x) over the field with the least aliases, by least squares; the derivative of the
/// kernel itself, which the source takes, has exactly x h(x) and (x + m) h(x + m) for its aliases,
/// and deltas where the kernel jumps.
/// *Source*: Totsuka 1993, eq. 4 and 5, the filter of V . grad H.
class MomentKernel {
public:
    /// `padding`: of the axis; the field ends at 1/(2 padding) of the period.
    MomentKernel(const Kernel &kernel, double padding);

    int width() const { return m_shape.width(); }
    /// K(t), odd; zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const { return m_shape.value(t); }
    /// k(x) = integral of K(t) sin(2 pi t x) dt, nearly x h(x). *Units*: x in padded periods.
    double response(double x) const { return m_shape.transform(x); }

    /// The weights of all taps by symmetry, see PiecewiseKernel::pairs.
    int terms() const { return m_shape.terms(); }
    const std::vector<float> &pairs() const { return m_shape.pairs(); }

private:
    PiecewiseKernel m_shape;
};

} // namespace pellucid::fourier
