// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/transform.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <thread>
#include <vector>

#include <fftw3.h>

namespace pellucid::fourier {

namespace {

// FFTW's planner is the one part of it that is not safe to call from two threads.
std::mutex &plannerMutex() {
    static std::mutex mutex;
    return mutex;
}

int threadCount() {
    return int(std::max(1U, std::thread::hardware_concurrency()));
}

template <class Real> struct Fftw;

template <> struct Fftw<float> {
    using Plan = fftwf_plan;
    using Complex = fftwf_complex;
    static void useThreads(int count) {
        static const int ready = fftwf_init_threads();
        if (ready != 0)
            fftwf_plan_with_nthreads(count);
    }
    static constexpr auto planForward = &fftwf_plan_many_dft_r2c;
    static constexpr auto planInverse = &fftwf_plan_dft_c2r_2d;
    static constexpr auto run = &fftwf_execute;
    static constexpr auto runOn = &fftwf_execute_dft_c2r;
    static constexpr auto destroy = &fftwf_destroy_plan;
};

template <> struct Fftw<double> {
    using Plan = fftw_plan;
    using Complex = fftw_complex;
    static void useThreads(int count) {
        static const int ready = fftw_init_threads();
        if (ready != 0)
            fftw_plan_with_nthreads(count);
    }
    static constexpr auto planForward = &fftw_plan_many_dft_r2c;
    static constexpr auto planInverse = &fftw_plan_dft_c2r_2d;
    static constexpr auto run = &fftw_execute;
    static constexpr auto runOn = &fftw_execute_dft_c2r;
    static constexpr auto destroy = &fftw_destroy_plan;
};

template <class Real>
void forward(std::complex<Real> *data, volume::GridSize size, int rowStride, int planeRows) {
    using F = Fftw<Real>;
    const std::array<int, 3> n{size.k, size.j, size.i};
    const std::array<int, 3> realRows{size.k, planeRows, 2 * rowStride};
    const std::array<int, 3> complexRows{size.k, planeRows, rowStride};
    auto *const real = reinterpret_cast<Real *>(data);
    auto *const complex = reinterpret_cast<typename F::Complex *>(data);
    typename F::Plan plan;
    {
        const std::lock_guard lock(plannerMutex());
        F::useThreads(threadCount());
        plan = F::planForward(3, n.data(), 1, real, realRows.data(), 1, 0, complex,
                              complexRows.data(), 1, 0, FFTW_ESTIMATE);
    }
    F::run(plan);
    const std::lock_guard lock(plannerMutex());
    F::destroy(plan);
}

} // namespace

void forwardTransform3d(std::complex<float> *data, volume::GridSize size, int rowStride,
                        int planeRows) {
    forward(data, size, rowStride, planeRows);
}

void forwardTransform3d(std::complex<double> *data, volume::GridSize size, int rowStride,
                        int planeRows) {
    forward(data, size, rowStride, planeRows);
}

template <class Real> struct InverseTransform2d<Real>::Plan {
    int rows, columns;
    typename Fftw<Real>::Plan plan;
};

template <class Real>
InverseTransform2d<Real>::InverseTransform2d(int rows, int columns)
    : m_plan(new Plan{rows, columns, {}}) {
    using F = Fftw<Real>;
    // Below 512^2 starting threads costs more than they save.
    const int threads = std::size_t(rows) * columns >= 512 * 512 ? threadCount() : 1;
    // ESTIMATE does not touch the arrays, which only tell that in and out differ; UNALIGNED lets
    // the plan run on any arrays later.
    std::vector<Real> out(2);
    std::vector<std::complex<Real>> in(2);
    const std::lock_guard lock(plannerMutex());
    F::useThreads(threads);
    m_plan->plan = F::planInverse(rows, columns, reinterpret_cast<typename F::Complex *>(in.data()),
                                  out.data(), FFTW_ESTIMATE | FFTW_DESTROY_INPUT | FFTW_UNALIGNED);
}

template <class Real> InverseTransform2d<Real>::~InverseTransform2d() {
    const std::lock_guard lock(plannerMutex());
    Fftw<Real>::destroy(m_plan->plan);
}

template <class Real> int InverseTransform2d<Real>::rows() const {
    return m_plan->rows;
}
template <class Real> int InverseTransform2d<Real>::columns() const {
    return m_plan->columns;
}

template <class Real> void InverseTransform2d<Real>::run(std::complex<Real> *in, Real *out) const {
    using F = Fftw<Real>;
    F::runOn(m_plan->plan, reinterpret_cast<typename F::Complex *>(in), out);
}

template class InverseTransform2d<float>;
template class InverseTransform2d<double>;

} // namespace pellucid::fourier
