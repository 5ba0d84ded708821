// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fourier/kernels/kernel.h"
#include "core/fourier/kernels/piecewise_kernel.h"

namespace pellucid::fourier {

/// The odd kernel that reads the derivative of the spectrum along one axis from a spectrum that was
/// prepared for a `Kernel`: not the field, but the field times the distance from the wrap voxel.
///
/// It is the odd piecewise polynomial of the kernel's width and of degree max(3, width) whose
/// response is closest to x h(x) over the field with the least aliases, by least squares. The
/// source takes the derivative of the kernel itself: its response is exactly x h(x), but its
/// aliases are (x + m) h(x + m), and it has a delta wherever the kernel jumps. *Source*: Totsuka
/// 1993, eq. 4 and 5, the filter of V . grad H.
class MomentKernel {
public:
    /// `padding` is that of the axis: the field ends at 1/(2 padding) of the period.
    MomentKernel(const Kernel &kernel, double padding);

    int width() const { return m_shape.width(); }
    /// K(t), odd; zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const { return m_shape.value(t); }
    /// k(x) = integral of K(t) sin(2 pi t x) dt, close to x h(x). *Units*: x in padded periods.
    double response(double x) const { return m_shape.transform(x); }

    /// The weights of all taps, split by symmetry; see PiecewiseKernel::pairs.
    int terms() const { return m_shape.terms(); }
    const std::vector<float> &pairs() const { return m_shape.pairs(); }

private:
    PiecewiseKernel m_shape;
};

} // namespace pellucid::fourier
