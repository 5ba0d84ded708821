// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/adaptive_slice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/bench/measure.h"

namespace pellucid::bench {

AdaptiveSlice::AdaptiveSlice(const fourier::Spectrum &spectrum)
    : m_spectrum(spectrum), m_apron(spectrum.cellLayout().apron),
      m_columns(spectrum.layout().padded.i / 2 + 1 + 2 * m_apron),
      m_rows(spectrum.layout().padded.j + 2 * m_apron),
      m_planes(spectrum.layout().padded.k + 2 * m_apron) {
    m_cells.resize(std::size_t(m_columns) * m_rows * m_planes);
    const volume::GridSize padded = spectrum.layout().padded;
    for (int r = -padded.k / 2 - m_apron; r < padded.k / 2 + m_apron; ++r)
        for (int q = -padded.j / 2 - m_apron; q < padded.j / 2 + m_apron; ++q)
            for (int p = -m_apron; p <= padded.i / 2 + m_apron; ++p)
                m_cells[at(p, q, r)] = std::complex<float>(spectrum.value(p, q, r));
}

std::size_t AdaptiveSlice::at(int p, int q, int r) const {
    const volume::GridSize padded = m_spectrum.layout().padded;
    return (std::size_t(r + padded.k / 2 + m_apron) * m_rows + (q + padded.j / 2 + m_apron)) *
               m_columns +
           (p + m_apron);
}

// A cell is marked if it and every cell within the kernel's reach and one more are weak: then the
// cell next to a frequency tells of all that its kernel reads.
void AdaptiveSlice::mark(float threshold) {
    if (threshold == m_threshold)
        return;
    m_threshold = threshold;
    m_weak.assign(m_cells.size(), 0);
    for (std::size_t n = 0; n < m_cells.size(); ++n)
        m_weak[n] = std::abs(m_cells[n]) <= threshold ? 1 : 0;
    const int reach = m_spectrum.layout().width() / 2 + 1;
    // Erosion by a cube, axis by axis.
    const std::array<std::size_t, 3> stride{1, std::size_t(m_columns),
                                            std::size_t(m_columns) * m_rows};
    const std::array<int, 3> length{m_columns, m_rows, m_planes};
    for (int axis = 0; axis < 3; ++axis) {
        const auto before = m_weak;
        for (std::size_t n = 0; n < m_cells.size(); ++n) {
            const int place = int(n / stride[axis] % std::size_t(length[axis]));
            for (int d = -reach; d <= reach; ++d)
                if (place + d >= 0 && place + d < length[axis] &&
                    before[std::size_t(std::ptrdiff_t(n) + d * std::ptrdiff_t(stride[axis]))] == 0)
                    m_weak[n] = 0;
        }
    }
}

AdaptiveSlice::Slice AdaptiveSlice::extract(const render::Camera &camera, int size,
                                            double tolerance) {
    const auto &layout = m_spectrum.layout();
    const volume::Lattice &lattice = m_spectrum.lattice();
    const int width = layout.width();
    const glm::dmat3 axes = camera.axes();
    const double ds = 1.0 / (size * camera.pixelMm);
    Slice slice;
    slice.samples.assign(std::size_t(size) * (size / 2 + 1), {});
    // Corrected bound: relative error <= T sum|H2 - H1| / rms of the slice, with T the largest
    // weak cell; the sum of |H| over the taps in 3D and the single tap bound it.
    if (tolerance > 0.0) {
        const Slice exact = extract(camera, size, 0.0);
        double energy = 0.0, sumOfTaps = 0.0;
        for (const auto &value : exact.samples)
            energy += double(std::norm(value));
        for (int tap = 0; tap < width; ++tap)
            sumOfTaps += std::abs(layout.kernels[0].value(tap - 0.5 * (width - 1)));
        const double difference = std::pow(sumOfTaps, 3) + 1.0;
        mark(float(tolerance * std::sqrt(energy / double(exact.frequencies)) / difference));
    }
    const double start = millisecondsNow();
    for (int row = -size / 2 + 1; row < size / 2; ++row)
        for (int column = 0; column < size / 2; ++column) {
            if (4.0 * (double(row) * row + double(column) * column) >= double(size) * size)
                break;
            const glm::dvec3 s = ds * (double(column) * axes[0] + double(row) * axes[1]);
            std::array<double, 3> g{};
            for (int d = 0; d < 3; ++d) {
                const double q = glm::dot(lattice.step(d), s);
                g[d] = (q - std::round(q)) * layout.padded[d];
            }
            const bool mirrored = g[0] < 0.0;
            for (double &value : g)
                value = mirrored ? -value : value;
            ++slice.frequencies;
            std::complex<float> sum = 0.0F;
            const std::size_t nearest =
                at(int(std::lround(g[0])), int(std::lround(g[1])), int(std::lround(g[2])));
            if (tolerance > 0.0 && m_weak[nearest] != 0) {
                sum = m_cells[nearest];
                ++slice.cellsRead;
            } else {
                std::array<int, 3> first{};
                std::array<std::array<float, 8>, 3> weight{};
                for (int d = 0; d < 3; ++d) {
                    first[d] = int(std::ceil(g[d] - 0.5 * width));
                    const double c = first[d] - g[d] + 0.5 * width - 0.5;
                    // The kernel's own polynomials, as the engine evaluates them.
                    const auto &kernel = layout.kernels[d];
                    const int terms = kernel.terms();
                    const float *pair = kernel.pairs().data();
                    const auto cc = float(c * c), cf = float(c);
                    for (int k = 0; k < (width + 1) / 2; ++k, pair += 2 * terms) {
                        float even = 0.0F, odd = 0.0F;
                        for (int n = terms - 1; n >= 0; --n) {
                            even = even * cc + pair[n];
                            odd = odd * cc + pair[terms + n];
                        }
                        weight[d][k] = even + cf * odd;
                        weight[d][width - 1 - k] =
                            2 * k == width - 1 ? weight[d][k] : even - cf * odd;
                    }
                }
                for (int z = 0; z < width; ++z)
                    for (int y = 0; y < width; ++y) {
                        const auto *cells =
                            m_cells.data() + at(first[0], first[1] + y, first[2] + z);
                        std::complex<float> line = 0.0F;
                        for (int x = 0; x < width; ++x)
                            line += weight[0][x] * cells[x];
                        sum += weight[1][y] * weight[2][z] * line;
                    }
                slice.cellsRead += std::size_t(width) * width * width;
            }
            slice.samples[std::size_t(row < 0 ? row + size : row) * (size / 2 + 1) + column] =
                mirrored ? std::conj(sum) : sum;
        }
    slice.milliseconds = millisecondsNow() - start;
    return slice;
}

} // namespace pellucid::bench
