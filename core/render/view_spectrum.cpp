// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/view_spectrum.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/fourier/kernels/premultiplier.h"
#include "core/fourier/transforms/strip_copies.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/fourier/transforms/transform.h"
#include "core/render/plane_sum.h"
#include "core/render/reasons.h"
#include "core/render/view_cells.h"
#include "core/system/page_memory.h"

namespace pellucid::render {

namespace {

using Complex = std::complex<float>;
using fourier::stripFloats;
using fourier::stripLanes;
using plan::ShearedAxis;

constexpr int roundUp(int n, int multiple) {
    return (n + multiple - 1) / multiple * multiple;
}
int modulo(int index, int period) {
    return (index % period + period) % period;
}

template <class T> class Pages {
public:
    explicit Pages(std::size_t count)
        : m_memory(system::allocatePages(count * sizeof(T), task::because::anImageOfThisSize)) {}
    T *data() const { return reinterpret_cast<T *>(m_memory.get()); }

private:
    std::shared_ptr<std::byte[]> m_memory;
};

// See `ReadCells`.
const std::vector<float> &readTable() {
    static const std::vector<float> table = [] {
        std::vector<float> values((ReadCells::offsets + 1) * ReadCells::tableStride, 0.0F);
        for (int n = 0; n <= ReadCells::offsets; ++n)
            for (int tap = 0; tap < ReadCells::taps; ++tap) {
                const double t = double(n) / ReadCells::offsets - 0.5 * ReadCells::taps + tap;
                const auto weight = float(plan::readKernel().value(t));
                float *const to = values.data() + std::size_t(n) * ReadCells::tableStride;
                to[tap] = weight;
                to[ReadCells::across + 2 * std::size_t(tap)] =
                    to[ReadCells::across + 2 * std::size_t(tap) + 1] = weight;
            }
        return values;
    }();
    return table;
}

} // namespace

ViewSpectrum::ViewSpectrum(const volume::Field &field, const volume::VoxelBox &box,
                           const plan::ShearedGrid &grid, const task::Progress &progress)
    : m_grid(grid) {
    for (std::size_t d = 0; d < 2; ++d)
        m_reach[d] = grid.axes[d].reach() + ReadCells::margin;
    const int columns = roundUp(std::min(grid.axes[0].padded / 2, m_reach[0]) + 1, stripLanes);
    const PlaneSum sum(field, box, m_grid);
    const Pages<float> sums(std::size_t(sum.rowFloats()) * std::size_t(grid.axes[1].cells));
    sum.run(sums.data(), progress);
    progress.check();
    arrange(transformed(sums.data(), sum.segment(), columns), columns);
}

// The transform of the sums, with `middle` of each axis at position 0: `columns` of each row.
std::vector<Complex> ViewSpectrum::transformed(const float *sums, int segment, int columns) const {
    const ShearedAxis &along = m_grid.axes[0], &across = m_grid.axes[1];
    const fourier::Kernel &kernel = plan::readKernel();
    const int m = along.cellsPerSample;
    const auto factorsAlong = fourier::premultiplier(kernel, along.cells, along.padded),
               factorsAcross = fourier::premultiplier(kernel, across.cells, across.padded);
    const fourier::ForwardTransform1d rows(along.padded);
    const std::size_t half = std::size_t(roundUp(std::max(along.padded / 2 + 1, columns), 16));
    tbb::enumerable_thread_specific<Pages<float>> rowScratch(
        [&] { return Pages<float>(std::size_t(along.padded) + 16 + 2 * half); });
    std::vector<Complex> halves(std::size_t(across.cells) * std::size_t(columns));
    tbb::parallel_for(0, across.cells, [&](int row) {
        float *const real = rowScratch.local().data();
        auto *const out = reinterpret_cast<Complex *>(real + roundUp(along.padded, 16));
        std::fill_n(real, along.padded, 0.0F);
        const float *const from = sums + std::size_t(row) * std::size_t(m * segment);
        const float factor = factorsAcross[std::size_t(row)];
        for (int n = 0; n < along.cells; ++n) {
            const int cell = n - along.middle();
            real[cell < 0 ? cell + along.padded : cell] =
                factor * factorsAlong[std::size_t(n)] * from[(n % m) * segment + n / m];
        }
        std::fill_n(out, half, Complex());
        rows.run(real, out);
        std::copy_n(out, columns, halves.data() + std::size_t(row) * std::size_t(columns));
    });
    const fourier::StripTransform strips(across.padded);
    const int middle = across.middle(), outer = std::max(middle, across.cells - 1 - middle);
    tbb::enumerable_thread_specific<Pages<float>> stripScratch(
        [&] { return Pages<float>(2 * std::size_t(across.padded) * stripFloats); });
    std::vector<Complex> spectrum(std::size_t(across.padded) * std::size_t(columns));
    tbb::parallel_for(0, columns / stripLanes, [&](int strip) {
        float *const data = stripScratch.local().data();
        const auto at = [&](int n) {
            return data + std::size_t(modulo(n, across.padded)) * stripFloats;
        };
        for (int n = -outer; n <= outer; ++n)
            if (const int row = n + middle; row >= 0 && row < across.cells)
                fourier::loadExchanged(halves.data() + std::size_t(row) * std::size_t(columns) +
                                           std::size_t(strip) * stripLanes,
                                       at(n));
            else
                std::fill_n(at(n), stripFloats, 0.0F);
        const float *const result =
            strips.run(data, data + std::size_t(across.padded) * stripFloats, outer);
        fourier::storeExchanged(result, across.padded, 1.0F,
                                spectrum.data() + std::size_t(strip) * stripLanes,
                                std::size_t(columns));
    });
    return spectrum;
}

// Lays the cells out as the kernel reads them: without wrapping around.
void ViewSpectrum::arrange(const std::vector<Complex> &spectrum, int columns) {
    const ShearedAxis &along = m_grid.axes[0], &across = m_grid.axes[1];
    constexpr int margin = ReadCells::margin;
    m_stride = std::size_t(margin + m_reach[0] + 1) + ReadCells::across; // the last taps read more
    m_cells.resize(m_stride * std::size_t(2 * m_reach[1] + 1));
    tbb::parallel_for(-m_reach[1], m_reach[1] + 1, [&](int j) {
        Complex *const to = m_cells.data() + std::size_t(j + m_reach[1]) * m_stride;
        const auto rowOf = [&](int row) {
            return spectrum.data() + std::size_t(modulo(row, across.padded)) * std::size_t(columns);
        };
        const Complex *const row = rowOf(j), *const mirrored = rowOf(-j);
        for (int i = -margin; i <= m_reach[0]; ++i) {
            const int cell = modulo(i, along.padded);
            to[i + margin] =
                cell <= along.padded / 2 ? row[cell] : std::conj(mirrored[along.padded - cell]);
        }
    });
}

void ViewSpectrum::read(const Row &row, Complex *values) const {
    std::array<double, 2> first, step;
    for (std::size_t d = 0; d < 2; ++d) {
        const double cells = m_grid.axes[d].cellsPerCycle();
        first[d] = cells * row.first[m_grid.axes[d].axis];
        step[d] = cells * row.step[m_grid.axes[d].axis];
    }
    const Complex *const zero =
        m_cells.data() + std::size_t(m_reach[1]) * m_stride + ReadCells::margin;
    const ReadCells cells{reinterpret_cast<const float *>(zero),
                          std::ptrdiff_t(2 * m_stride),
                          readTable().data(),
                          {double(m_grid.axes[0].padded), double(m_grid.axes[1].padded)}};
    readLine(cells, first, step, row.count, values);
}

} // namespace pellucid::render
