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

constexpr int width = 13;
constexpr double padding = 2.0;
constexpr int margin = width / 2; // cells beyond each end of a row
constexpr double pi = std::numbers::pi;

// The shape parameter of the kernel: 1 % below that of Potts and Tasche 2021 (sinh-type window),
// which leaves a sixth of the aliases.
const double shape = 0.99 * pi * width * (1.0 - 0.5 / padding);

double kernel(double t) {
    const double x = 2.0 * t / width;
    return std::abs(x) < 1.0 ? std::sinh(shape * std::sqrt(1.0 - x * x)) : 0.0;
}

// The kernel's Fourier transform in closed form. *Requires*: |x| <= padded / (2 padding), where
// the root is real.
double apodisation(double x, int padded) {
    const double turn = pi * width * x / padded;
    const double z = std::sqrt(shape * shape - turn * turn);
    return 0.5 * width * pi * shape * std::cyl_bessel_i(1.0, z) / z;
}

volume::GridSize paddedSizes(const volume::GridSize &size) {
    const auto pad = [](int n) { return fourier::paddedSize(std::max(n, width), padding); };
    return {pad(size.i), pad(size.j), pad(size.k)};
}

int rowStride(const volume::GridSize &padded) {
    return padded.i / 2 + 1 + 2 * margin;
}

int modulo(int index, int period) {
    const int m = index % period;
    return m < 0 ? m + period : m;
}

} // namespace

std::size_t WideKernel::bytes(const volume::VoxelBox &box) {
    const volume::GridSize padded = paddedSizes(box.size());
    return std::size_t(rowStride(padded)) * padded.j * padded.k * sizeof(std::complex<double>);
}

WideKernel::WideKernel(const volume::Field &field, const volume::VoxelBox &box,
                       const task::Progress &progress)
    : m_lattice(field.lattice()), m_padded(paddedSizes(box.size())),
      m_rowStride(rowStride(m_padded)) {
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
            auto *row =
                reinterpret_cast<double *>(m_cells.data() + rowAt(j - middle.j, k - middle.k));
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
    const auto eachRow = [&](const auto &work) {
        tbb::parallel_for(0, m_padded.k, [&](int k) {
            for (int j = 0; j < m_padded.j; ++j)
                work(j, k);
        });
    };
    eachRow([&](int j, int k) {
        auto *row = reinterpret_cast<double *>(m_cells.data() + rowAt(j, k));
        for (int i = 0; i < m_padded.i; ++i)
            row[i] *= hx[i];
    });
    progress.report(0.4);
    fourier::forwardTransform3d(m_cells.data() + margin, m_padded, m_rowStride, m_padded.j);
    // Half of the spectrum is stored. The kernel also reads cells beyond: the conjugates of others.
    eachRow([&](int j, int k) {
        std::complex<double> *const row = m_cells.data() + rowAt(j, k);
        const std::complex<double> *const mirrored = m_cells.data() + rowAt(-j, -k);
        const int last = m_padded.i / 2;
        for (int n = 1; n <= margin; ++n) {
            row[-n] = std::conj(mirrored[n]);
            row[last + n] = std::conj(mirrored[m_padded.i - last - n]);
        }
    });
    progress.report(1.0);
}

std::size_t WideKernel::rowAt(int j, int k) const {
    return (std::size_t(modulo(k, m_padded.k)) * m_padded.j + modulo(j, m_padded.j)) * m_rowStride +
           margin;
}

void WideKernel::sample(const std::vector<glm::dvec3> &frequencies,
                        std::vector<std::complex<double>> &values) const {
    const glm::dvec3 shift = m_lattice.center().mm - m_wrapPoint.mm;
    for (std::size_t n = 0; n < frequencies.size(); ++n) {
        const glm::dvec3 &s = frequencies[n];
        glm::dvec3 cell;
        for (int d = 0; d < 3; ++d) {
            const double cycles = glm::dot(m_lattice.step(d), s);
            cell[d] = (cycles - std::round(cycles)) * m_padded[d];
        }
        const bool isMirrored = cell.x < 0.0;
        if (isMirrored)
            cell = -cell;
        std::array<std::array<double, width>, 3> weights;
        std::array<int, 3> first;
        for (int d = 0; d < 3; ++d) {
            first[d] = int(std::ceil(cell[d] - 0.5 * width));
            for (int t = 0; t < width; ++t)
                weights[d][t] = kernel(first[d] + t - cell[d]);
        }
        // Real and imaginary parts in turns.
        std::array<double, 2 * width> sums{};
        for (int k = 0; k < width; ++k)
            for (int j = 0; j < width; ++j) {
                const auto *row = reinterpret_cast<const double *>(
                    m_cells.data() + rowAt(first[1] + j, first[2] + k) + first[0]);
                const double weight = weights[2][k] * weights[1][j];
                for (int i = 0; i < 2 * width; ++i)
                    sums[i] += weight * row[i];
            }
        std::complex<double> sum = 0.0;
        for (int i = 0; i < width; ++i)
            sum += weights[0][i] * std::complex<double>(sums[2 * i], sums[2 * i + 1]);
        values[n] =
            (isMirrored ? std::conj(sum) : sum) * std::polar(1.0, 2.0 * pi * glm::dot(s, shift));
    }
}

std::vector<double> WideKernel::image(const scene::Camera &camera,
                                      const scene::ImageDefinition &image) const {
    return sliceImage([this](const auto &s, auto &values) { sample(s, values); }, m_lattice, camera,
                      image);
}

} // namespace pellucid::reference
