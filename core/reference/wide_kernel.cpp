// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reference/wide_kernel.h"

#include <array>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "core/fourier/transforms/padded_size.h"
#include "core/fourier/transforms/transform.h"
#include "core/reference/reasons.h"
#include "core/task/error.h"

namespace pellucid::reference {

namespace {

constexpr int width = 12;
constexpr double padding = 2.0;
constexpr double pi = std::numbers::pi;

double shapeParameter() {
    const double x = width / padding * (padding - 0.5);
    return pi * std::sqrt(x * x - 0.8);
}

double kernel(double t) {
    const double x = 2.0 * t / width;
    if (std::abs(x) > 1.0)
        return 0.0;
    static const double b = shapeParameter();
    static const double peak = std::cyl_bessel_i(0.0, b);
    return std::cyl_bessel_i(0.0, b * std::sqrt(1.0 - x * x)) / peak;
}

// The kernel's Fourier transform in closed form: w sinh(z)/z / I0(b), z^2 = b^2 - (pi w x/P)^2.
double apodisation(double x, int padded) {
    const double b = shapeParameter();
    const double turn = pi * width * x / padded;
    const double square = b * b - turn * turn;
    const double z = std::sqrt(std::abs(square));
    const double ratio = z < 1e-9 ? 1.0 : square > 0.0 ? std::sinh(z) / z : std::sin(z) / z;
    return width * ratio / std::cyl_bessel_i(0.0, b);
}

volume::GridSize paddedSizes(const volume::GridSize &size) {
    const auto pad = [](int n) { return fourier::paddedSize(std::max(n, width), padding); };
    return {pad(size.i), pad(size.j), pad(size.k)};
}

int modulo(int index, int period) {
    const int m = index % period;
    return m < 0 ? m + period : m;
}

} // namespace

std::size_t WideKernel::bytes(const volume::VoxelBox &box) {
    const volume::GridSize padded = paddedSizes(box.size());
    return std::size_t(padded.i / 2 + 1) * padded.j * padded.k * sizeof(std::complex<double>);
}

WideKernel::WideKernel(const volume::Field &field, const volume::VoxelBox &box,
                       const task::Progress &progress)
    : m_lattice(field.lattice()), m_padded(paddedSizes(box.size())),
      m_rowStride(m_padded.i / 2 + 1) {
    const volume::GridSize size = box.size();
    const volume::VoxelIndex middle{size.i / 2, size.j / 2, size.k / 2};
    m_wrapPoint = m_lattice.patient(
        volume::VoxelIndex{box.lo.i + middle.i, box.lo.j + middle.j, box.lo.k + middle.k});
    task::orOutOfMemory(task::because::noMemoryForTheReference, [&] {
        m_cells.resize(std::size_t(m_rowStride) * m_padded.j * m_padded.k);
    });
    const double cell = m_lattice.cellVolumeMm3();
    std::vector<float> buffer(std::size_t(size.i));
    for (int k = 0; k < size.k; ++k) {
        progress.report(0.3 * k / size.k);
        for (int j = 0; j < size.j; ++j) {
            const double factor = cell / (apodisation(k - middle.k, m_padded.k) *
                                          apodisation(j - middle.j, m_padded.j));
            auto *row = reinterpret_cast<double *>(
                m_cells.data() + (std::size_t(modulo(k - middle.k, m_padded.k)) * m_padded.j +
                                  modulo(j - middle.j, m_padded.j)) *
                                     m_rowStride);
            const float *const samples =
                field.row({box.lo.i, j + box.lo.j, k + box.lo.k}, size.i, buffer.data());
            for (int i = 0; i < size.i; ++i)
                row[modulo(i - middle.i, m_padded.i)] = double(samples[i]) * factor;
        }
    }
    // Computes the factor along x once per column, not once per sample.
    std::vector<double> hx(m_padded.i, 0.0);
    for (int i = 0; i < size.i; ++i)
        hx[modulo(i - middle.i, m_padded.i)] = 1.0 / apodisation(i - middle.i, m_padded.i);
    tbb::parallel_for(std::size_t(0), std::size_t(m_padded.j) * m_padded.k, [&](std::size_t r) {
        auto *row = reinterpret_cast<double *>(m_cells.data() + r * m_rowStride);
        for (int i = 0; i < m_padded.i; ++i)
            row[i] *= hx[i];
    });
    progress.report(0.4);
    fourier::forwardTransform3d(m_cells.data(), m_padded, m_rowStride, m_padded.j);
    progress.report(1.0);
}

void WideKernel::sample(const std::vector<glm::dvec3> &frequencies,
                        std::vector<std::complex<double>> &values) const {
    const glm::dvec3 shift = m_lattice.center().mm - m_wrapPoint.mm;
    for (std::size_t n = 0; n < frequencies.size(); ++n) {
        const glm::dvec3 &s = frequencies[n];
        std::array<std::array<double, width>, 3> weights;
        std::array<int, 3> first;
        for (int d = 0; d < 3; ++d) {
            const double g = glm::dot(m_lattice.step(d), s) * m_padded[d];
            first[d] = int(std::ceil(g - 0.5 * width));
            for (int t = 0; t < width; ++t)
                weights[d][t] = kernel(first[d] + t - g);
        }
        std::complex<double> sum = 0.0;
        for (int k = 0; k < width; ++k)
            for (int j = 0; j < width; ++j) {
                std::complex<double> row = 0.0;
                for (int i = 0; i < width; ++i) {
                    int x = modulo(first[0] + i, m_padded.i);
                    int y = modulo(first[1] + j, m_padded.j), z = modulo(first[2] + k, m_padded.k);
                    const bool mirrored = x > m_padded.i / 2;
                    if (mirrored) {
                        x = m_padded.i - x;
                        y = modulo(-y, m_padded.j);
                        z = modulo(-z, m_padded.k);
                    }
                    const auto cell = m_cells[(std::size_t(z) * m_padded.j + y) * m_rowStride + x];
                    row += weights[0][i] * (mirrored ? std::conj(cell) : cell);
                }
                sum += weights[2][k] * weights[1][j] * row;
            }
        values[n] = sum * std::polar(1.0, 2.0 * pi * glm::dot(s, shift));
    }
}

std::vector<double> WideKernel::image(const scene::Camera &camera,
                                      const scene::ImageDefinition &image) const {
    return sliceImage([this](const auto &s, auto &values) { sample(s, values); }, m_lattice, camera,
                      image);
}

} // namespace pellucid::reference
