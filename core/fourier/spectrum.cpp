// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/spectrum.h"

#include <cassert>
#include <cstdlib>
#include <cstring>
#include <new>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/fourier/transform.h"
#include "core/task/error.h"

namespace pellucid::fourier {

namespace {

using volume::GridSize;

constexpr int apron = Spectrum::apron;

struct Extent {
    std::size_t x, y, z;
    explicit Extent(GridSize padded)
        // Rows are a multiple of 64 bytes, so that every row starts on a cache line.
        : x((std::size_t(padded.i / 2 + 1 + 2 * apron) + 7) / 8 * 8), y(padded.j + 2 * apron),
          z(padded.k + 2 * apron) {}
};

// 1/h along one axis for the samples of the box, the wrap voxel being the middle one.
std::vector<float> premultiplier(const Kernel &kernel, int samples, int padded) {
    std::vector<float> factors(samples);
    for (int n = 0; n < samples; ++n)
        factors[n] = float(1.0 / kernel.apodisation(n - samples / 2, padded));
    return factors;
}

int wrapped(int index, int period) {
    return index < 0 ? index + period : index;
}

} // namespace

std::size_t SpectrumLayout::bytes() const {
    const Extent extent(padded);
    return extent.x * extent.y * extent.z * sizeof(std::complex<float>);
}

Spectrum::Spectrum(const volume::Volume &field, const SpectrumLayout &layout)
    : m_lattice(field.lattice()), m_layout(layout) {
    const volume::VoxelBox &box = layout.box;
    const GridSize size = box.size();
    m_wrapPoint = m_lattice.patient(
        volume::VoxelIndex{box.lo.i + size.i / 2, box.lo.j + size.j / 2, box.lo.k + size.k / 2});
    const Extent extent(layout.padded);
    // One cache line more, because the widest loads reach past the last tap.
    const std::size_t cells = extent.x * extent.y * extent.z + 8;
    void *const memory =
        std::aligned_alloc(64, (cells * sizeof(std::complex<float>) + 63) / 64 * 64);
    if (memory == nullptr)
        throw task::Error(
            task::ErrorCode::outOfMemory,
            fmt::format("not enough memory for a spectrum of {} MB", layout.bytes() >> 20));
    m_cells.reset(static_cast<std::complex<float> *>(memory), [](auto *p) { std::free(p); });
    m_rowStride = std::ptrdiff_t(extent.x);
    m_planeStride = std::ptrdiff_t(extent.x * extent.y);
    m_origin = m_cells.get() + apron * (m_planeStride + m_rowStride + 1);
}

Spectrum Spectrum::prepare(const volume::Volume &field, const SpectrumLayout &layout,
                           const task::Progress &progress) {
    assert(field.isFloat());
    Spectrum spectrum(field, layout);
    const GridSize lattice = field.lattice().size();
    const GridSize size = layout.box.size();
    const GridSize padded = layout.padded;
    const Extent extent(padded);

    // Premultiply and wrap: sample n goes to (n - middle) modulo padded.
    const auto hx = premultiplier(layout.kernel, size.i, padded.i);
    const auto hy = premultiplier(layout.kernel, size.j, padded.j);
    const auto hz = premultiplier(layout.kernel, size.k, padded.k);
    const auto cell = float(field.lattice().cellVolumeMm3());
    field.visit([&](auto samples) {
        tbb::parallel_for(0, int(extent.z), [&](int z) {
            progress.check();
            std::memset(static_cast<void *>(spectrum.m_cells.get() + z * spectrum.m_planeStride), 0,
                        std::size_t(spectrum.m_planeStride) * sizeof(std::complex<float>));
        });
        tbb::parallel_for(0, size.k, [&](int k) {
            progress.check();
            const int z = wrapped(k - size.k / 2, padded.k);
            for (int j = 0; j < size.j; ++j) {
                const int y = wrapped(j - size.j / 2, padded.j);
                const float factor = cell * hz[k] * hy[j];
                const auto *in =
                    samples.data() +
                    (std::size_t(k + layout.box.lo.k) * lattice.j + j + layout.box.lo.j) *
                        lattice.i +
                    layout.box.lo.i;
                auto *row = reinterpret_cast<float *>(
                    spectrum.m_origin + z * spectrum.m_planeStride + y * spectrum.m_rowStride);
                const int middle = size.i / 2;
                float *negative = row + padded.i - middle;
                for (int i = 0; i < middle; ++i)
                    negative[i] = float(in[i]) * factor * hx[i];
                for (int i = middle; i < size.i; ++i)
                    row[i - middle] = float(in[i]) * factor * hx[i];
            }
        });
    });
    progress.report(0.25);

    forwardTransform3d(spectrum.m_origin, padded, int(spectrum.m_rowStride), int(extent.y));
    progress.report(0.9);

    // The apron: beyond the half by F(-s) = conj F(s), around the period by copying.
    const std::ptrdiff_t rowStride = spectrum.m_rowStride, planeStride = spectrum.m_planeStride;
    tbb::parallel_for(0, padded.k, [&](int z) {
        const int mirroredZ = (padded.k - z) % padded.k;
        for (int y = 0; y < padded.j; ++y) {
            const int mirroredY = (padded.j - y) % padded.j;
            std::complex<float> *row = spectrum.m_origin + z * planeStride + y * rowStride;
            const std::complex<float> *mirror =
                spectrum.m_origin + mirroredZ * planeStride + mirroredY * rowStride;
            for (int m = 1; m <= apron; ++m) {
                row[-m] = std::conj(mirror[m]);
                row[padded.i / 2 + m] = std::conj(mirror[padded.i / 2 - m]);
            }
        }
    });
    const auto rowBytes = std::size_t(rowStride) * sizeof(std::complex<float>);
    tbb::parallel_for(0, padded.k, [&](int z) {
        auto *plane = spectrum.m_origin + z * planeStride - apron;
        for (int m = 1; m <= apron; ++m) {
            std::memcpy(static_cast<void *>(plane - m * rowStride),
                        plane + (padded.j - m) * rowStride, rowBytes);
            std::memcpy(static_cast<void *>(plane + (padded.j + m - 1) * rowStride),
                        plane + (m - 1) * rowStride, rowBytes);
        }
    });
    auto *first = spectrum.m_cells.get();
    const auto planeBytes = std::size_t(planeStride) * sizeof(std::complex<float>);
    for (int m = 0; m < apron; ++m) {
        std::memcpy(static_cast<void *>(first + m * planeStride),
                    first + (padded.k + m) * planeStride, planeBytes);
        std::memcpy(static_cast<void *>(first + (padded.k + apron + m) * planeStride),
                    first + (apron + m) * planeStride, planeBytes);
    }
    progress.report(1.0);
    return spectrum;
}

} // namespace pellucid::fourier
