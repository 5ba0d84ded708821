// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/adaptive_slice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/bench/measure.h"

namespace pellucid::bench {

namespace {

// The filters alternate, because the clock of a machine may change within a second.
constexpr int runsOfView = 3;

// How often a stored sample occurs in the whole slice: the other half mirrors all columns but the
// first.
double timesInSlice(const AdaptiveSlice::Slice &slice, std::size_t sample) {
    return sample % (std::size_t(slice.size) / 2 + 1) == 0 ? 1.0 : 2.0;
}

double energyOf(const AdaptiveSlice::Slice &slice) {
    double energy = 0.0;
    for (std::size_t n = 0; n < slice.samples.size(); ++n)
        energy += timesInSlice(slice, n) * double(std::norm(slice.samples[n]));
    return energy;
}

} // namespace

AdaptiveSlice::AdaptiveSlice(const fourier::Spectrum &spectrum)
    : m_spectrum(spectrum), m_halo(spectrum.cellLayout().halo),
      m_columns(spectrum.layout().padded.i / 2 + 1 + 2 * m_halo),
      m_rows(spectrum.layout().padded.j + 2 * m_halo),
      m_planes(spectrum.layout().padded.k + 2 * m_halo) {
    m_cells.resize(std::size_t(m_columns) * m_rows * m_planes);
    const volume::GridSize padded = spectrum.layout().padded;
    for (int r = -padded.k / 2 - m_halo; r < padded.k / 2 + m_halo; ++r)
        for (int q = -padded.j / 2 - m_halo; q < padded.j / 2 + m_halo; ++q)
            for (int p = -m_halo; p <= padded.i / 2 + m_halo; ++p)
                m_cells[at(p, q, r)] = std::complex<float>(spectrum.value(p, q, r));
}

std::size_t AdaptiveSlice::at(int p, int q, int r) const {
    const volume::GridSize padded = m_spectrum.layout().padded;
    return (std::size_t(r + padded.k / 2 + m_halo) * m_rows + (q + padded.j / 2 + m_halo)) *
               m_columns +
           (p + m_halo);
}

// Marks a cell if it and all cells within the kernel's reach plus one are weak. The mark of the
// cell nearest a frequency then holds for all cells that its kernel reads.
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

// Corrected bound: relative error <= T sum|H2 - H1| / rms of the slice, with T the largest weak
// cell; the sums of |H2| and of |H1| over the taps in 3D bound that of their difference.
float AdaptiveSlice::threshold(const Slice &exact, double tolerance) const {
    double wide = 1.0;
    for (const fourier::Kernel &kernel : m_spectrum.layout().kernels) {
        double sumOfTaps = 0.0;
        for (int tap = 0; tap < kernel.width(); ++tap)
            sumOfTaps += std::abs(kernel.value(tap - 0.5 * (kernel.width() - 1)));
        wide *= sumOfTaps;
    }
    // Counts the first column twice, which keeps the bound safe and the code short.
    const double frequencies = 2.0 * double(exact.frequencies);
    return float(tolerance * std::sqrt(energyOf(exact) / frequencies) / (wide + 1.0));
}

// The wide kernel's value at a position in the stored half. *Units*: cells.
std::complex<float> AdaptiveSlice::wideSample(const std::array<double, 3> &g) const {
    const auto &layout = m_spectrum.layout();
    const int width = layout.width();
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
            weight[d][width - 1 - k] = 2 * k == width - 1 ? weight[d][k] : even - cf * odd;
        }
    }
    std::complex<float> sum = 0.0F;
    for (int z = 0; z < width; ++z)
        for (int y = 0; y < width; ++y) {
            const auto *cells = m_cells.data() + at(first[0], first[1] + y, first[2] + z);
            std::complex<float> line = 0.0F;
            for (int x = 0; x < width; ++x)
                line += weight[0][x] * cells[x];
            sum += weight[1][y] * weight[2][z] * line;
        }
    return sum;
}

AdaptiveSlice::Slice AdaptiveSlice::extract(const scene::Camera &camera, int size,
                                            double tolerance) {
    const auto &layout = m_spectrum.layout();
    const volume::Lattice &lattice = m_spectrum.lattice();
    const std::size_t taps = std::size_t(layout.width()) * layout.width() * layout.width();
    const glm::dmat3 axes = camera.axes();
    const double ds = 1.0 / (size * camera.pixelMm);
    Slice slice{.size = size};
    slice.samples.assign(std::size_t(size) * (size / 2 + 1), {});
    if (tolerance > 0.0)
        mark(threshold(extract(camera, size, 0.0), tolerance));
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
                // Unweighted: two other weights, that of the volume's middle and the best for a
                // field that fills the box's ellipsoid, read more cells at -40 dB.
                sum = m_cells[nearest];
                ++slice.cellsRead;
            } else {
                sum = wideSample(g);
                slice.cellsRead += taps;
            }
            slice.samples[std::size_t(row < 0 ? row + size : row) * (size / 2 + 1) + column] =
                mirrored ? std::conj(sum) : sum;
        }
    slice.milliseconds = millisecondsNow() - start;
    return slice;
}

double relativeL2(const AdaptiveSlice::Slice &slice, const AdaptiveSlice::Slice &exact) {
    AdaptiveSlice::Slice difference = slice;
    for (std::size_t n = 0; n < exact.samples.size(); ++n)
        difference.samples[n] -= exact.samples[n];
    return std::sqrt(energyOf(difference) / energyOf(exact));
}

AdaptiveComparison compareFilters(AdaptiveSlice &slices, const scene::Camera &camera, int size,
                                  std::span<const glm::dquat> views, double bound) {
    AdaptiveComparison comparison{.bound = bound};
    std::vector<double> wideMs, adaptiveMs;
    scene::Camera turned = camera;
    for (const glm::dquat &view : views) {
        turned.orientation = view;
        const auto wide = slices.extract(turned, size, 0.0),
                   adaptive = slices.extract(turned, size, bound);
        double fastestWide = wide.milliseconds, fastestAdaptive = adaptive.milliseconds;
        for (int again = 1; again < runsOfView; ++again) {
            fastestWide = std::min(fastestWide, slices.extract(turned, size, 0.0).milliseconds);
            fastestAdaptive =
                std::min(fastestAdaptive, slices.extract(turned, size, bound).milliseconds);
        }
        wideMs.push_back(fastestWide);
        adaptiveMs.push_back(fastestAdaptive);
        comparison.frequencies += double(wide.frequencies) / double(views.size());
        comparison.wideCells += double(wide.cellsRead) / double(views.size());
        comparison.adaptiveCells += double(adaptive.cellsRead) / double(views.size());
        comparison.relativeL2 = std::max(comparison.relativeL2, relativeL2(adaptive, wide));
    }
    comparison.wideMs = median(wideMs);
    comparison.adaptiveMs = median(adaptiveMs);
    return comparison;
}

AdaptiveComparison compareFiltersAt(AdaptiveSlice &slices, const scene::Camera &camera, int size,
                                    std::span<const glm::dquat> views, double relativeL2) {
    const auto at = [&](double bound) {
        return compareFilters(slices, camera, size, views, bound);
    };
    // The bound holds, so the error at a bound of `relativeL2` is not above it.
    AdaptiveComparison within = at(relativeL2), beyond = within;
    while (beyond.relativeL2 <= relativeL2) {
        within = beyond;
        if (within.adaptiveCells == within.frequencies) // the narrow filter alone suffices
            return within;
        beyond = at(10.0 * within.bound);
    }
    while (beyond.bound > 1.02 * within.bound) {
        AdaptiveComparison between = at(std::sqrt(within.bound * beyond.bound));
        (between.relativeL2 <= relativeL2 ? within : beyond) = between;
    }
    return within;
}

double multiplyAdds(double cellsRead, bool cued) {
    return 2.0 * (cued ? 2.0 : 1.0) * cellsRead;
}

} // namespace pellucid::bench
