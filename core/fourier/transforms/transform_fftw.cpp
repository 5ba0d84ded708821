// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/transforms/transform.h"

#include <array>
#include <cstdlib>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <fftw3.h>
#include <tbb/parallel_for.h>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/fourier/transforms/reasons.h"
#include "core/fourier/transforms/wisdom.h"
#include "core/system/page_memory.h"
#include "core/task/error.h"

namespace pellucid::fourier {

namespace {

// The planner is the only part of FFTW that is not safe to call from two threads.
std::mutex &plannerMutex() {
    static std::mutex mutex;
    return mutex;
}

// Plans have this many parts on any machine, and oneTBB runs the parts on the threads that it has:
// the bits do not depend on the number of threads, and oneTBB's limit on threads holds here, too.
constexpr int parts = 8;

void runParts(void *(*work)(char *), char *jobs, std::size_t size, int count, void *) {
    tbb::parallel_for(0, count, [=](int n) { work(jobs + size * std::size_t(n)); });
}

template <class Real> struct Fftw;

template <> struct Fftw<float> {
    using Plan = fftwf_plan;
    using Complex = fftwf_complex;
    static void useThreads(int count) {
        static const bool ready = [] {
            const bool started = fftwf_init_threads() != 0;
            fftwf_threads_set_callback(runParts, nullptr);
            return started;
        }();
        if (ready)
            fftwf_plan_with_nthreads(count);
    }
    static constexpr auto planForward = &fftwf_plan_many_dft_r2c;
    static constexpr auto planInverse = &fftwf_plan_dft_c2r_2d;
    static constexpr auto runInverse = &fftwf_execute_dft_c2r;
    static constexpr auto destroy = &fftwf_destroy_plan;
};

template <> struct Fftw<double> {
    using Plan = fftw_plan;
    using Complex = fftw_complex;
    static void useThreads(int count) {
        static const bool ready = [] {
            const bool started = fftw_init_threads() != 0;
            fftw_threads_set_callback(runParts, nullptr);
            return started;
        }();
        if (ready)
            fftw_plan_with_nthreads(count);
    }
    static constexpr auto planForward = &fftw_plan_many_dft_r2c;
    static constexpr auto planInverse = &fftw_plan_dft_c2r_2d;
    static constexpr auto runInverse = &fftw_execute_dft_c2r;
    static constexpr auto destroy = &fftw_destroy_plan;
};

template <class Real>
typename Fftw<Real>::Plan planForward3d(std::complex<Real> *data, volume::GridSize size,
                                        int rowStride, int planeRows) {
    using F = Fftw<Real>;
    const std::array<int, 3> n{size.k, size.j, size.i};
    const std::array<int, 3> realRows{size.k, planeRows, 2 * rowStride};
    const std::array<int, 3> complexRows{size.k, planeRows, rowStride};
    auto *const real = reinterpret_cast<Real *>(data);
    auto *const complex = reinterpret_cast<typename F::Complex *>(data);
    const std::lock_guard lock(plannerMutex());
    F::useThreads(parts);
    return F::planForward(3, n.data(), 1, real, realRows.data(), 1, 0, complex, complexRows.data(),
                          1, 0, FFTW_ESTIMATE);
}

} // namespace

void forwardTransform3d(std::complex<double> *data, volume::GridSize size, int rowStride,
                        int planeRows) {
    const auto plan = planForward3d(data, size, rowStride, planeRows);
    fftw_execute(plan);
    const std::lock_guard lock(plannerMutex());
    fftw_destroy_plan(plan);
}

struct ForwardTransform3d::Plan {
    fftwf_plan plan;
};

ForwardTransform3d::ForwardTransform3d(std::complex<float> *data, volume::GridSize size,
                                       int rowStride, int planeRows)
    : m_plan(new Plan{planForward3d(data, size, rowStride, planeRows)}) {}

ForwardTransform3d::~ForwardTransform3d() {
    const std::lock_guard lock(plannerMutex());
    fftwf_destroy_plan(m_plan->plan);
}

void ForwardTransform3d::run() const {
    fftwf_execute(m_plan->plan);
}

namespace {

std::filesystem::path &wisdomFile() {
    static std::filesystem::path file;
    return file;
}

// Call with the planner locked.
std::string wisdom() {
    char *const text = fftwf_export_wisdom_to_string();
    std::string result = text != nullptr ? text : "";
    std::free(text);
    return result;
}

// Imports the wisdom of a file; one that cannot be read, such as a folder, or is not understood, is
// ignored. Call with the planner locked.
void readWisdom(const std::filesystem::path &path) {
    constexpr std::size_t maxWisdomBytes = 16 << 20;
    try {
        fftwf_import_wisdom_from_string(files::readText(path, maxWisdomBytes).c_str());
    } catch (const task::Error &) { // not there yet, or not readable
    }
}

bool saveWisdom() {
    // Another process may have added plans meanwhile.
    readWisdom(wisdomFile());
    const std::string text = wisdom();
    try {
        files::AtomicFile file(wisdomFile());
        file.write(text);
        file.commit();
        return true;
    } catch (const task::Error &) {
        return false;
    }
}

} // namespace

void keepWisdomIn(const std::filesystem::path &file) {
    const std::lock_guard lock(plannerMutex());
    wisdomFile() = file;
    // Threads add solvers, and wisdom is only valid for the same solvers.
    Fftw<float>::useThreads(1);
    readWisdom(file);
}

void estimatePlans() {
    const std::lock_guard lock(plannerMutex());
    wisdomFile().clear();
    fftwf_forget_wisdom();
}

struct ForwardTransform1d::Plan {
    fftwf_plan plan;
};

ForwardTransform1d::ForwardTransform1d(int length) : m_plan(new Plan{}) {
    const auto in = system::allocatePages(std::size_t(length) * sizeof(float), task::because::aRow);
    const auto out = system::allocatePages((std::size_t(length) / 2 + 1) * 2 * sizeof(float),
                                           task::because::aRow);
    const std::lock_guard lock(plannerMutex());
    Fftw<float>::useThreads(1);
    const auto plan = [&](unsigned how) {
        return fftwf_plan_dft_r2c_1d(length, reinterpret_cast<float *>(in.get()),
                                     reinterpret_cast<fftwf_complex *>(out.get()),
                                     how | FFTW_PRESERVE_INPUT);
    };
    // MEASURE times plans for a few milliseconds, and may choose a different plan the next time.
    // Only a plan that was saved is used, so that two runs give the same bits.
    if (!wisdomFile().empty()) {
        m_plan->plan = plan(FFTW_WISDOM_ONLY | FFTW_MEASURE);
        if (m_plan->plan != nullptr)
            return;
        const fftwf_plan measured = plan(FFTW_MEASURE);
        const bool saved = saveWisdom();
        fftwf_destroy_plan(measured);
        // Another process may have saved a plan for this length.
        if (saved)
            m_plan->plan = plan(FFTW_WISDOM_ONLY | FFTW_MEASURE);
        if (m_plan->plan != nullptr)
            return;
        fftwf_forget_wisdom();
        wisdomFile().clear();
    }
    m_plan->plan = plan(FFTW_ESTIMATE);
}

ForwardTransform1d::~ForwardTransform1d() {
    const std::lock_guard lock(plannerMutex());
    fftwf_destroy_plan(m_plan->plan);
}

void ForwardTransform1d::run(const float *in, std::complex<float> *out) const {
    fftwf_execute_dft_r2c(m_plan->plan, const_cast<float *>(in),
                          reinterpret_cast<fftwf_complex *>(out));
}

template <class Real> struct InverseTransform2d<Real>::Plan { typename Fftw<Real>::Plan plan; };

template <class Real>
InverseTransform2d<Real>::InverseTransform2d(int rows, int columns, Planning planning)
    : m_plan(new Plan{}) {
    using F = Fftw<Real>;
    const bool isMeasured = planning == Planning::measure;
    // Below 512^2 parallel parts cost more than they save.
    const int threads = !isMeasured && std::size_t(rows) * columns >= 512 * 512 ? parts : 1;
    // Only measuring reads and writes the arrays; an estimate only needs two different addresses.
    const std::size_t samples = isMeasured ? std::size_t(rows) * columns : 2,
                      cells = isMeasured ? std::size_t(rows) * (std::size_t(columns) / 2 + 1) : 2;
    std::vector<Real> out(samples);
    std::vector<std::complex<Real>> in(cells);
    const std::lock_guard lock(plannerMutex());
    F::useThreads(threads);
    m_plan->plan = F::planInverse(rows, columns, reinterpret_cast<typename F::Complex *>(in.data()),
                                  out.data(),
                                  FFTW_DESTROY_INPUT | (isMeasured ? FFTW_MEASURE : FFTW_ESTIMATE));
}

template <class Real> InverseTransform2d<Real>::~InverseTransform2d() {
    const std::lock_guard lock(plannerMutex());
    Fftw<Real>::destroy(m_plan->plan);
}

template <class Real> void InverseTransform2d<Real>::run(std::complex<Real> *in, Real *out) const {
    using F = Fftw<Real>;
    F::runInverse(m_plan->plan, reinterpret_cast<typename F::Complex *>(in), out);
}

template class InverseTransform2d<float>;
template class InverseTransform2d<double>;

} // namespace pellucid::fourier
