// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/spectrum_passes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/fourier/kernels/premultiplier.h"
#include "core/fourier/reasons.h"
#include "core/fourier/transforms/strip_copies.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/fourier/transforms/transform.h"
#include "core/system/page_memory.h"
#include "core/volume/lane_sum.h"

namespace pellucid::fourier {

namespace {

using volume::GridSize;
using Complex = std::complex<float>;

// Scratch memory per thread; uninitialised, 64-byte aligned.
template <class T> class Scratch {
public:
    explicit Scratch(std::size_t count)
        : m_memory([count] {
              return system::allocatePages(count * sizeof(T), task::because::rowsOfATransform);
          }) {}
    T *local() { return reinterpret_cast<T *>(m_memory.local().get()); }

private:
    tbb::enumerable_thread_specific<std::shared_ptr<std::byte[]>> m_memory;
};

int modulo(int index, int period) {
    return (index % period + period) % period;
}

// Transforms strips, the middle one at index 0, with zeros between the last and the first.
const float *transformPadded(const StripTransform &transform, const float *from, int count,
                             float *strips) {
    const int padded = transform.length(), middle = count / 2, after = count - middle;
    std::memcpy(strips, from + std::size_t(middle) * stripFloats,
                std::size_t(after) * stripFloats * sizeof(float));
    if (after == middle) // the transform reads `middle` strips on both sides of the first
        std::fill_n(strips + std::size_t(after) * stripFloats, stripFloats, 0.0F);
    std::memcpy(strips + std::size_t(padded - middle) * stripFloats, from,
                std::size_t(middle) * stripFloats * sizeof(float));
    return transform.run(strips, strips + std::size_t(padded) * stripFloats, middle);
}

// Transforms the rows of planes along x. Sample n goes to (n - middle) modulo padded. The cells to
// the left and right of the half follow from those inside: F(-s) = conj F(s) for the rows of a real
// field.
class RowTransform {
public:
    RowTransform(const volume::Field &field, const SpectrumLayout &layout, const CellLayout &cells,
                 ColumnMemory &memory)
        : m_field(field), m_box(layout.box), m_size(layout.box.size()), m_padded(layout.padded),
          m_cells(cells), m_memory(memory), m_cellMm3(field.lattice().cellVolumeMm3()),
          m_rowCells(std::size_t(cells.step) * (cells.columns - 1) + CellLayout::columnCells),
          m_hx(premultiplier(layout.kernels[0], m_size.i, m_padded.i)),
          m_hy(premultiplier(layout.kernels[1], m_size.j, m_padded.j)),
          m_hz(premultiplier(layout.kernels[2], m_size.k, m_padded.k)), m_alongX(m_padded.i),
          m_planeSums(std::size_t(m_size.k)), m_samples(std::size_t(m_size.i)),
          m_realRows(m_padded.i), m_halves(std::size_t(m_padded.i) / 2 + 1), m_rows(m_rowCells),
          m_strips(stripFloats) {}

    // Transforms plane k of the box. Thread-safe.
    void run(int k) {
        float *const samples = m_samples.local(), *const real = m_realRows.local();
        Complex *const half = m_halves.local(), *const row = m_rows.local();
        std::fill(real, real + m_padded.i, 0.0F);
        const auto cell = float(m_cellMm3);
        PlaneSums sums;
        for (int j = 0; j < m_size.j; ++j) {
            const float *const in =
                m_field.row({m_box.lo.i, j + m_box.lo.j, k + m_box.lo.k}, m_size.i, samples);
            sums.magnitudes += double(placeRow(in, cell * m_hz[k] * m_hy[j], real));
            addRow(in, j, sums);
            m_alongX.run(real, half);
            extend(half, row);
            writeStrips(row, k, j);
        }
        finishStreaming();
        m_planeSums[std::size_t(k)] = sums;
    }

    // The sums of all planes so far.
    FieldSums sums() const {
        FieldSums sums;
        for (int k = 0; k < m_size.k; ++k) {
            const PlaneSums &plane = m_planeSums[std::size_t(k)];
            sums.dc += m_cellMm3 * plane.all;
            sums.moments[0] += m_cellMm3 * plane.alongI;
            sums.moments[1] += m_cellMm3 * plane.alongJ;
            sums.moments[2] += m_cellMm3 * plane.all * (k - m_size.k / 2);
            sums.magnitudes += plane.magnitudes;
        }
        return sums;
    }

private:
    struct PlaneSums {
        double all = 0.0, alongI = 0.0, alongJ = 0.0, magnitudes = 0.0;
    };

    // Returns the sum of the magnitudes.
    float placeRow(const float *in, float factor, float *real) const {
        const int middle = m_size.i / 2;
        const float *const hx = m_hx.data();
        float *const negative = real + m_padded.i - middle;
        for (int i = 0; i < middle; ++i)
            negative[i] = in[i] * factor * hx[i];
        for (int i = middle; i < m_size.i; ++i)
            real[i - middle] = in[i] * factor * hx[i];
        return volume::laneSum(middle, [&](int i) { return std::abs(negative[i]); }) +
               volume::laneSum(m_size.i - middle, [&](int i) { return std::abs(real[i]); });
    }

    void addRow(const float *in, int j, PlaneSums &sums) const {
        const int middle = m_size.i / 2;
        const double sum = volume::laneSum(m_size.i, [&](int i) { return double(in[i]); }),
                     moment = volume::laneSum(m_size.i,
                                              [&](int i) { return double(in[i]) * (i - middle); });
        sums.all += sum;
        sums.alongI += moment;
        sums.alongJ += sum * (j - m_size.j / 2);
    }

    void extend(const Complex *half, Complex *row) const {
        const int last = m_padded.i / 2, halo = m_cells.halo;
        for (int m = 1; m <= halo; ++m) {
            row[halo - m] = std::conj(half[m]);
            row[halo + last + m] = std::conj(half[last - m]);
        }
        std::copy_n(half, last + 1, row + halo);
        std::fill(row + 2 * halo + last + 1, row + m_rowCells, Complex());
    }

    void writeStrips(const Complex *row, int k, int j) {
        float *const strip = m_strips.local();
        for (int column = 0; column < m_cells.columns; ++column) {
            loadExchanged(row + std::size_t(column) * m_cells.step, strip);
            streamLine(strip, m_memory.slab(column) + (std::size_t(k) * m_size.j + j) * stripFloats,
                       stripFloats * sizeof(float));
        }
    }

    const volume::Field &m_field;
    volume::VoxelBox m_box;
    GridSize m_size, m_padded;
    const CellLayout &m_cells;
    ColumnMemory &m_memory;
    double m_cellMm3;
    std::size_t m_rowCells;
    std::vector<float> m_hx, m_hy, m_hz;
    ForwardTransform1d m_alongX;
    std::vector<PlaneSums> m_planeSums;
    Scratch<float> m_samples, m_realRows;
    Scratch<Complex> m_halves, m_rows;
    Scratch<float> m_strips;
};

// Transforms x columns along y, then along z, and stores their cells; rows and planes of padding
// are skipped. All threads work on one column, so that its result of the first step is the only one
// in memory.
template <class Cell> class ColumnTransform {
public:
    ColumnTransform(const SpectrumLayout &layout, const CellLayout &cells, std::byte *out,
                    float scale)
        : m_size(layout.box.size()), m_padded(layout.padded), m_cells(cells), m_out(out),
          m_scale(scale), m_alongY(layout.padded.j), m_alongZ(layout.padded.k),
          m_planes(system::allocatePages(planeBytes(layout), task::because::aTransform)),
          m_strips(2 * std::size_t(std::max(m_padded.j, m_padded.k)) * stripFloats),
          m_lines(std::size_t(rowsTogether) * m_padded.k * CellLayout::columnCells) {}

    // `slab`: [k][j][strip]; after that, it is no longer needed.
    void alongY(const float *slab, const task::Progress &progress) {
        tbb::parallel_for(0, m_size.k, [&](int k) {
            progress.check();
            float *const strips = m_strips.local();
            const float *const result = transformPadded(
                m_alongY, slab + std::size_t(k) * m_size.j * stripFloats, m_size.j, strips);
            for (int y = 0; y < m_padded.j; ++y)
                streamLine(result + std::size_t(y) * stripFloats, planes(y, k),
                           stripFloats * sizeof(float));
            finishStreaming();
        });
    }

    void alongZ(int column, const task::Progress &progress) {
        tbb::parallel_for(0, (m_padded.j + rowsTogether - 1) / rowsTogether, [&](int group) {
            progress.check();
            Cell *const lines = m_lines.local();
            const int first = group * rowsTogether,
                      count = std::min(rowsTogether, m_padded.j - first);
            for (int y = first; y < first + count; ++y)
                transformRow(y, lines + std::size_t(y - first) * rowCells());
            writeLines(column, first, count, lines);
        });
    }

private:
    // Their lines are neighbours: see CellLayout.
    static constexpr int rowsTogether = 4;

    float *planes(int y, int k) const {
        return reinterpret_cast<float *>(m_planes.get()) +
               (std::size_t(y) * m_size.k + k) * stripFloats;
    }
    std::size_t rowCells() const { return std::size_t(m_padded.k) * CellLayout::columnCells; }

    // `lines`: [z][16 cells].
    void transformRow(int y, Cell *lines) {
        float *const strips = m_strips.local();
        const float *const result = transformPadded(m_alongZ, planes(y, 0), m_size.k, strips);
        storeExchanged(result, m_padded.k, m_scale, lines, CellLayout::columnCells);
    }

    void writeLines(int column, int first, int count, const Cell *lines) const {
        constexpr std::size_t lineBytes = CellLayout::columnCells * sizeof(Cell);
        constexpr int together = CellLayout::planesTogether;
        for (int group = 0; group < m_cells.planes; group += together)
            for (int y = first; y < first + count; ++y)
                for (int row = modulo(y - m_cells.firstY, m_padded.j); row < m_cells.rows;
                     row += m_padded.j)
                    for (int plane = group; plane < group + together; ++plane) {
                        const int z = modulo(plane + m_cells.firstZ, m_padded.k);
                        streamLine(lines + std::size_t(y - first) * rowCells() +
                                       std::size_t(z) * CellLayout::columnCells,
                                   m_out + m_cells.line(column, plane, row) * lineBytes, lineBytes);
                    }
        finishStreaming();
    }

    GridSize m_size, m_padded;
    const CellLayout &m_cells;
    std::byte *m_out;
    float m_scale;
    StripTransform m_alongY, m_alongZ;
    std::shared_ptr<std::byte[]> m_planes; ///< of a column: [y][k][strip]
    Scratch<float> m_strips;
    Scratch<Cell> m_lines;
};

template <class Cell>
void transformAllColumns(const SpectrumLayout &layout, const CellLayout &cells,
                         ColumnMemory &memory, float scale, const task::Progress &progress) {
    ColumnTransform<Cell> transform(layout, cells, memory.cells(), scale);
    for (int column = 0; column < cells.columns; ++column) {
        transform.alongY(memory.slab(column), progress);
        transform.alongZ(column, progress);
        progress.report(double(column + 1) / cells.columns);
    }
}

std::size_t slabBytes(const SpectrumLayout &layout) {
    const GridSize size = layout.box.size();
    return std::size_t(size.k) * size.j * stripFloats * sizeof(float);
}

} // namespace

ColumnMemory::ColumnMemory(const SpectrumLayout &layout, const CellLayout &cells)
    : m_cellBytes(layout.bytes()), m_slabBytes(slabBytes(layout)), m_bytes(bytes(layout)),
      m_columns(cells.columns), m_memory(system::allocatePages(m_bytes, task::because::aSpectrum)) {
}

float *ColumnMemory::slab(int column) const {
    // Slabs end where the memory ends. Either slabs are larger than the cells of a column and begin
    // with them, or they are smaller: in both cases, slab c starts behind the cells of column c
    // - 1.
    const std::size_t after = std::size_t(m_columns - column) * m_slabBytes;
    return reinterpret_cast<float *>(m_memory.get() + (m_bytes - after));
}

std::shared_ptr<std::byte[]> ColumnMemory::takeCells() {
    constexpr std::size_t readable = 64;
    std::memset(m_memory.get() + (m_cellBytes - readable), 0, readable);
    system::returnPages(m_memory.get(), m_bytes, m_cellBytes);
    return std::move(m_memory);
}

std::size_t ColumnMemory::bytes(const SpectrumLayout &layout) {
    return std::max(layout.bytes(),
                    std::size_t(CellLayout(layout).columns) * slabBytes(layout) + 64);
}

std::size_t planeBytes(const SpectrumLayout &layout) {
    return std::size_t(layout.padded.j) * layout.box.size().k * stripFloats * sizeof(float);
}

FieldSums transformRows(const volume::Field &field, const SpectrumLayout &layout,
                        const CellLayout &cells, ColumnMemory &memory,
                        const task::Progress &progress) {
    RowTransform rows(field, layout, cells, memory);
    tbb::parallel_for(0, layout.box.size().k, [&](int k) {
        progress.check();
        rows.run(k);
    });
    return rows.sums();
}

void transformColumns(const SpectrumLayout &layout, const CellLayout &cells, ColumnMemory &memory,
                      float scale, const task::Progress &progress) {
    if (layout.storage == Storage::binary16)
        transformAllColumns<std::uint32_t>(layout, cells, memory, scale, progress);
    else
        transformAllColumns<Complex>(layout, cells, memory, scale, progress);
}

} // namespace pellucid::fourier
