// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/fourier/kernels/piecewise_kernel.h"

namespace pellucid::fourier {

/// An interpolation kernel on the frequency grid: even, of integer width, a polynomial on every
/// unit interval. The polynomials define the kernel, and the de-apodisation is computed from them:
/// fitting a formula by polynomials costs no accuracy.
///
/// Taps: for a coordinate g, tap k = 0..width-1 is at grid index first(g) + k,
/// first(g) = ceil(g - width/2). Its distance from g is t_k = c + k - (width-1)/2 with
/// c = first(g) - g + width/2 - 1/2 in [-1/2, 1/2).
class Kernel {
public:
    static constexpr int largestWidth = 7;
    /// The most coefficients that the even or the odd part of a tap can have: degree 11.
    static constexpr int largestTerms = 6;

    /// The value at the nearest grid point. *Source*: Cheng 2007, 4.1.
    static Kernel nearest();
    /// The tent of width 2. *Source*: Cheng 2007, 2.3.3 and 4.2.
    static Kernel trilinear();
    /// Cubic convolution with slope -1/2. *Source*: Cheng 2007, eq. 21.
    static Kernel catmullRom();
    /// The cubic B-spline. It does not interpolate; the de-apodisation undoes its blur.
    static Kernel cubicBSpline();
    /// The sinc under a Hamming window of width 5, constants 25/46 and 21/46.
    /// *Source*: Cheng 2007, eq. 16-20, corrected.
    static Kernel hammingSinc();
    /// ES: exp(b (sqrt(1 - (2t/w)^2) - 1)), b = 0.976 pi w (1 - 1/(2 padding)); w = 2..7.
    /// *Source*: Barnett, Magland, af Klinteberg 2019.
    static Kernel exponentialSemicircle(int width, double padding);
    /// KB: I0(b sqrt(1 - (2t/w)^2)) / I0(b), b = pi sqrt((w/padding)^2 (padding - 1/2)^2 - 0.8);
    /// w = 2..7. *Source*: Beatty, Nishimura, Pauly 2005.
    static Kernel kaiserBessel(int width, double padding);
    /// LS: the piecewise polynomial of degree max(3, w) with the least energy in the aliases of a
    /// field, one by one and in phase (REFERENCES.md); w = 2..7. From width 3 on it has about half
    /// the error of ES or KB with the same taps, and needs fewer multiplications. The field fills
    /// the axis evenly, up to 1/(2 padding) of the period, for the padding rounded down to eighths.
    /// Kernels are kept: each takes milliseconds once.
    static Kernel leastAliasing(int width, double padding);
    /// A narrower kernel for a spectrum that was prepared for `wide`: its response is as close to
    /// the apodisation of `wide` over the field, with as little aliasing, as its width allows.
    /// `padding` is that of the axis.
    static Kernel narrower(const Kernel &wide, int width, double padding);

    const std::string &name() const { return m_name; }
    int width() const { return m_shape.width(); }
    /// H(t); zero for |t| > width/2. *Units*: t in grid cells.
    double value(double t) const { return m_shape.value(t); }
    /// h(x) = integral of H(t) cos(2 pi t x) dt: the factor by which the kernel darkens the volume
    /// at the distance x from the wrap voxel. *Units*: x in padded periods.
    double apodisation(double x) const { return m_shape.transform(x); }
    /// The integral of H^2.
    double energy() const { return m_shape.energy(); }

    /// The weights of all taps, split by symmetry; see PiecewiseKernel::pairs.
    int terms() const { return m_shape.terms(); }
    const std::vector<float> &pairs() const { return m_shape.pairs(); }

private:
    Kernel(std::string name, std::vector<std::vector<double>> pieces);
    static Kernel fitted(std::string name, int width, int degree,
                         const std::function<double(double t)> &shape);

    std::string m_name;
    PiecewiseKernel m_shape;
};

/// A kernel as the user names it, before it is tuned for a padding.
enum class KernelFamily {
    nearest,
    trilinear,
    catmullRom,
    cubicBSpline,
    hammingSinc,
    exponentialSemicircle,
    kaiserBessel,
    leastAliasing
};

struct KernelChoice {
    KernelFamily family = KernelFamily::leastAliasing;
    int width = 4;
    bool operator==(const KernelChoice &) const = default;
};

/// The kernel that is chosen, tuned for a padding.
Kernel makeKernel(const KernelChoice &choice, double padding);
/// "nearest", "trilinear", "catmull-rom", "b-spline", "hamming-sinc", "ES2".."ES7", "KB2".."KB7",
/// "LS2".."LS7", in any case. *Throws* Error{usage}.
KernelChoice kernelFromName(const std::string &name);
std::string kernelName(const KernelChoice &choice);

} // namespace pellucid::fourier
