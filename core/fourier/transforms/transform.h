// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <memory>

#include "core/volume/lattice.h"

namespace pellucid::fourier {

/// Real-to-complex 3D transform in place, exp(-i 2 pi ...), unnormalised.
/// *Shape*: `data` points at sample (0,0,0) of a row-major array whose rows hold `rowStride`
/// complex numbers and whose planes hold `planeRows` rows. The samples of a row are its first
/// size.i reals; its result is its first size.i/2 + 1 complex numbers.
void forwardTransform3d(std::complex<double> *data, volume::GridSize size, int rowStride,
                        int planeRows);

/// The same in float for one array: planned once, run often.
class ForwardTransform3d {
public:
    ForwardTransform3d(std::complex<float> *data, volume::GridSize size, int rowStride,
                       int planeRows);
    ~ForwardTransform3d();
    ForwardTransform3d(const ForwardTransform3d &) = delete;
    ForwardTransform3d &operator=(const ForwardTransform3d &) = delete;
    void run() const;

private:
    struct Plan;
    std::unique_ptr<Plan> m_plan;
};

/// Real-to-complex transform of one length, exp(-i 2 pi ...), unnormalised: planned once, run
/// often, from any thread.
class ForwardTransform1d {
public:
    explicit ForwardTransform1d(int length);
    ~ForwardTransform1d();
    ForwardTransform1d(const ForwardTransform1d &) = delete;
    ForwardTransform1d &operator=(const ForwardTransform1d &) = delete;
    /// *Shape*: in: length, not changed; out: length/2 + 1; both 64-byte aligned.
    void run(const float *in, std::complex<float> *out) const;

private:
    struct Plan;
    std::unique_ptr<Plan> m_plan;
};

/// How FFTW chooses a plan: by rule, or by timing several, which takes longer but runs faster.
enum class Planning { estimate, measure };

/// Complex-to-real inverse 2D transform of one size, exp(+i 2 pi ...), unnormalised: planned once,
/// run often, from any thread. The input is overwritten.
/// *Shape*: in: rows x (columns/2 + 1), out: rows x columns, contiguous, aligned as by `new`.
template <class Real> class InverseTransform2d { // float or double
public:
    /// A plan that is measured uses one thread.
    InverseTransform2d(int rows, int columns, Planning planning = Planning::estimate);
    ~InverseTransform2d();
    InverseTransform2d(const InverseTransform2d &) = delete;
    InverseTransform2d &operator=(const InverseTransform2d &) = delete;
    void run(std::complex<Real> *in, Real *out) const;

private:
    struct Plan;
    std::unique_ptr<Plan> m_plan;
};

} // namespace pellucid::fourier
