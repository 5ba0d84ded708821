// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/cpu_engine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/task/error.h"

namespace pellucid::render {

namespace {

using Complex = std::complex<float>;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

// K(q) for one axis. The smooth ones come from a table by linear interpolation: with 2048 entries
// per cycle the error is below (1/2048)^2 / 8 * max|K''| = 3e-8 * 7. The band limit has corners and
// is evaluated; so is what lies beyond the table, where pixels are much finer than the samples.
class FactorTable {
public:
    explicit FactorTable(const ImageDefinition &image) : m_image(image) {
        if (image.reconstruction == Reconstruction::bandLimited)
            return;
        m_values.resize(std::size_t(largest * perCycle) + 2);
        for (std::size_t n = 0; n < m_values.size(); ++n)
            m_values[n] = float(reconstructionFactor(image, double(n) / perCycle));
    }
    const ImageDefinition &definition() const { return m_image; }
    float operator()(double q) const {
        q = std::abs(q);
        if (m_values.empty() || q >= largest)
            return float(reconstructionFactor(m_image, q));
        const double at = q * perCycle;
        const auto n = std::size_t(at);
        const auto f = float(at - double(n));
        return m_values[n] + f * (m_values[n + 1] - m_values[n]);
    }

private:
    static constexpr double perCycle = 2048.0, largest = 16.0;
    ImageDefinition m_image;
    std::vector<float> m_values;
};

// The weighted sum over a kernel's support. Rows are read in whole groups of four floats, which the
// apron allows; the surplus is dropped.
template <int W>
Complex gather(const Complex *cells, std::ptrdiff_t rowStride, std::ptrdiff_t planeStride,
               const float *wx, const float *wy, const float *wz) {
    constexpr int lanes = (2 * W + 3) / 4 * 4;
    std::array<float, lanes> sum{};
    for (int k = 0; k < W; ++k)
        for (int j = 0; j < W; ++j) {
            const auto *row =
                reinterpret_cast<const float *>(cells + k * planeStride + j * rowStride);
            const float w = wz[k] * wy[j];
            for (int n = 0; n < lanes; ++n)
                sum[n] += w * row[n];
        }
    float re = 0.0F, im = 0.0F;
    for (int i = 0; i < W; ++i) {
        re += wx[i] * sum[2 * i];
        im += wx[i] * sum[2 * i + 1];
    }
    return {re, im};
}

// One coordinate on a periodic axis: the first tap and the centred offset that the kernel wants.
struct Taps {
    int first;
    float c;
};

Taps taps(double g, int width) {
    const double first = std::ceil(g - 0.5 * width);
    return {int(first), float(first - g + 0.5 * width - 0.5)};
}

template <int W> Complex sample(const fourier::Spectrum &spectrum, const glm::dvec3 &q) {
    const fourier::Kernel &kernel = spectrum.layout().kernel;
    const volume::GridSize padded = spectrum.layout().padded;
    // q modulo 1 in [0, 1); the half with x beyond 1/2 is the conjugate of its mirror image.
    glm::dvec3 f = q - glm::floor(q);
    const bool mirrored = f.x > 0.5;
    if (mirrored) {
        f = 1.0 - f;
        // A zero coordinate mirrors to itself, not to the far end of the period.
        f.y = f.y >= 1.0 ? 0.0 : f.y;
        f.z = f.z >= 1.0 ? 0.0 : f.z;
    }
    const Taps x = taps(f.x * padded.i, W), y = taps(f.y * padded.j, W),
               z = taps(f.z * padded.k, W);
    std::array<float, W> wx, wy, wz;
    kernel.weights(x.c, wx.data());
    kernel.weights(y.c, wy.data());
    kernel.weights(z.c, wz.data());
    const Complex *cells = spectrum.origin() + z.first * spectrum.planeStride() +
                           y.first * spectrum.rowStride() + x.first;
    const Complex value = gather<W>(cells, spectrum.rowStride(), spectrum.planeStride(), wx.data(),
                                    wy.data(), wz.data());
    return mirrored ? std::conj(value) : value;
}

std::vector<Complex> phases(int count, double cyclesPerStep) {
    std::vector<Complex> result(count);
    for (int n = 0; n < count; ++n) {
        const double turns = n * cyclesPerStep;
        const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
        result[n] = Complex(float(std::cos(angle)), float(std::sin(angle)));
    }
    return result;
}

template <int W>
void sliceRows(const fourier::Spectrum &spectrum, const Camera &camera, const FactorTable &factor,
               const SliceGrid &grid, Complex *slice) {
    const ImageDefinition &image = factor.definition();
    const glm::dmat3 axes = camera.axes();
    const volume::Lattice &lattice = spectrum.lattice();
    const double du = 1.0 / (grid.columns * camera.pixelMm),
                 dv = 1.0 / (grid.rows * camera.pixelMm);
    const double limit = 0.5 / camera.pixelMm;
    // q_d = a_d.s for one step along u and along image rows (downward, hence the sign).
    const glm::dmat3 steps(lattice.step(0), lattice.step(1), lattice.step(2));
    const glm::dvec3 qu = glm::transpose(steps) * axes[0] * du;
    const glm::dvec3 qv = glm::transpose(steps) * axes[1] * -dv;
    // exp(+i 2 pi s.(c - x_wrap)) and the position of the first pixel, split into u and v.
    const glm::dvec3 shift = lattice.center().mm - spectrum.wrapPoint().mm;
    const double firstU = camera.panMm.x - 0.5 * (camera.width - 1) * camera.pixelMm;
    const double firstV = camera.panMm.y + 0.5 * (camera.height - 1) * camera.pixelMm;
    const auto phaseU = phases(grid.columns / 2 + 1, du * (glm::dot(axes[0], shift) + firstU));
    const auto phaseV = phases(grid.rows / 2 + 1, -dv * (glm::dot(axes[1], shift) + firstV));
    const auto area = float(du * dv);

    const int stride = grid.columns / 2 + 1;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, grid.rows, 4), [&](const tbb::blocked_range<int> &range) {
            for (int r = range.begin(); r != range.end(); ++r) {
                Complex *row = slice + std::size_t(r) * stride;
                const int ky = r <= grid.rows / 2 ? r : r - grid.rows;
                const double sv = ky * dv;
                int end = 0;
                if (std::abs(ky) < grid.rows / 2) {
                    // The disc |s| < limit; its edge has roll-off 0, as have the Nyquist row and
                    // column.
                    end = int(std::ceil(std::sqrt(std::max(0.0, limit * limit - sv * sv)) / du));
                    end = std::min(end, grid.columns / 2);
                }
                const Complex rowPhase = ky >= 0 ? phaseV[ky] : std::conj(phaseV[-ky]);
                for (int kx = 0; kx < end; ++kx) {
                    const double su = kx * du;
                    const glm::dvec3 q = double(kx) * qu + double(ky) * qv;
                    const double radius = std::sqrt(su * su + sv * sv) / limit;
                    float weight = area * factor(q.x) * factor(q.y) * factor(q.z);
                    if (radius > 1.0 - image.rollOff)
                        weight *= float(rollOffFactor(image.rollOff, radius));
                    row[kx] = weight * (sample<W>(spectrum, q) * (phaseU[kx] * rowPhase));
                }
                std::fill(row + end, row + stride, Complex(0.0F));
            }
        });
}

// True if no part of the lattice can project outside the image, from any direction.
bool coversLattice(const Camera &camera, const volume::Lattice &lattice) {
    const glm::dvec2 half =
        0.5 * camera.pixelMm * glm::dvec2(camera.width, camera.height) - glm::abs(camera.panMm);
    return std::min(half.x, half.y) >= lattice.radiusMm() * (1.0 - 1e-9);
}

// An image that holds the whole projection sums to P(0), which the spectrum gives exactly at a grid
// point, for every view. The kernel's ghosts sum to zero over a period, but not over the image:
// they shift its sum by 1e-5 to 2e-4 from view to view. Scaling takes that part of the error away.
void conserveMass(ProjectionImage &image, double mass) {
    double sum = 0.0;
    for (const float p : image.samples)
        sum += p;
    const double scale = mass / sum;
    // Anything further from 1 is not a ghost: an empty field, or an image without a mean.
    if (!(std::abs(scale - 1.0) < 1e-3))
        return;
    for (float &p : image.samples)
        p = float(p * scale);
}

} // namespace

struct CpuEngine::Frame {
    explicit Frame(const SliceGrid &size)
        : grid(size), inverse(size.rows, size.columns),
          slice(std::size_t(size.rows) * (size.columns / 2 + 1)),
          plane(std::size_t(size.rows) * size.columns) {}
    SliceGrid grid;
    // Filling the table takes a millisecond: once per definition, not once per frame.
    std::optional<FactorTable> factor;
    fourier::InverseTransform2d<float> inverse;
    std::vector<Complex> slice;
    std::vector<float> plane;
};

CpuEngine::CpuEngine(std::shared_ptr<const fourier::Spectrum> spectrum)
    : m_spectrum(std::move(spectrum)) {}
CpuEngine::~CpuEngine() = default;

std::string CpuEngine::description() const {
    return "CPU engine, " + std::to_string(tbb::this_task_arena::max_concurrency()) + " threads";
}

CpuEngine::Frame &CpuEngine::frameFor(const SliceGrid &grid) {
    if (!m_frame || !(m_frame->grid == grid)) {
        m_frame.reset();
        try {
            m_frame = std::make_unique<Frame>(grid);
        } catch (const std::bad_alloc &) {
            throw task::Error(task::ErrorCode::outOfMemory,
                              "not enough memory for an image of this size");
        }
    }
    return *m_frame;
}

ProjectionImage CpuEngine::render(const Camera &camera, const ImageDefinition &image,
                                  FrameTimes *times) {
    const SliceGrid grid = sliceGrid(camera, m_spectrum->layout(), m_spectrum->lattice(), image);
    Frame &frame = frameFor(grid);
    const auto start = Clock::now();
    if (!frame.factor || !(frame.factor->definition() == image))
        frame.factor.emplace(image);
    switch (m_spectrum->layout().kernel.width()) {
    case 4:
        sliceRows<4>(*m_spectrum, camera, *frame.factor, grid, frame.slice.data());
        break;
    case 6:
        sliceRows<6>(*m_spectrum, camera, *frame.factor, grid, frame.slice.data());
        break;
    default:
        assert(m_spectrum->layout().kernel.width() == 5);
        sliceRows<5>(*m_spectrum, camera, *frame.factor, grid, frame.slice.data());
    }
    const auto sliced = Clock::now();
    const double mass = double(frame.slice[0].real()) * grid.columns * grid.rows;
    frame.inverse.run(frame.slice.data(), frame.plane.data());

    ProjectionImage result{camera.width, camera.height, camera.pixelMm,
                           std::vector<float>(std::size_t(camera.width) * camera.height)};
    for (int r = 0; r < camera.height; ++r) {
        const float *from = frame.plane.data() + std::size_t(r % grid.rows) * grid.columns;
        float *to = result.samples.data() + std::size_t(r) * camera.width;
        // An image wider than the period shows the empty part of it again.
        for (int c = 0; c < camera.width; c += grid.columns)
            std::copy_n(from, std::min(grid.columns, camera.width - c), to + c);
    }
    // A sharp band limit rings beyond the image: there the image's own sum is not P(0).
    if (image.reconstruction != Reconstruction::bandLimited && image.rollOff >= 0.03 &&
        coversLattice(camera, m_spectrum->lattice()))
        conserveMass(result, mass);
    if (times != nullptr)
        *times = {milliseconds(start, sliced), milliseconds(sliced, Clock::now())};
    return result;
}

} // namespace pellucid::render
