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

#include "core/fourier/binary16.h"
#include "core/fourier/transforms/strip_copies.h"
#include "core/fourier/transforms/strip_transform.h"
#include "core/fourier/transforms/transform.h"
#include "core/system/page_memory.h"

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

int blocksOf(GridSize padded) {
    return (padded.i / 2 + stripLanes) / stripLanes;
}

// 1/h along one axis for the samples of the box, with the wrap voxel in the middle.
std::vector<float> premultiplier(const Kernel &kernel, int samples, int padded) {
    std::vector<float> factors(samples);
    for (int n = 0; n < samples; ++n)
        factors[n] = float(1.0 / kernel.apodisation(double(n - samples / 2) / padded));
    return factors;
}

int modulo(int index, int period) {
    return (index % period + period) % period;
}

// Fills strips with those of `from`, with the middle one at index 0 and zeros in between.
void placeStrips(const float *from, int count, float *strips, int padded) {
    const int middle = count / 2, after = count - middle;
    std::memcpy(strips, from + std::size_t(middle) * stripFloats,
                std::size_t(after) * stripFloats * sizeof(float));
    std::memset(strips + std::size_t(after) * stripFloats, 0,
                std::size_t(padded - count) * stripFloats * sizeof(float));
    std::memcpy(strips + std::size_t(padded - middle) * stripFloats, from,
                std::size_t(middle) * stripFloats * sizeof(float));
}

std::uint32_t conjugate(std::uint32_t cell) {
    return cell ^ 0x80000000U;
}
Complex conjugate(Complex cell) {
    return std::conj(cell);
}

std::complex<float> asComplex(std::uint32_t cell) {
    return {fromBinary16(std::uint16_t(cell)), fromBinary16(std::uint16_t(cell >> 16))};
}
Complex asComplex(Complex cell) {
    return cell;
}

// Transforms along x and y plane by plane, so that a plane stays in the cache; rows and planes of
// padding are skipped. Sample n goes to (n - middle) modulo padded.
class PlaneTransform {
public:
    PlaneTransform(const volume::Lattice &lattice, const SpectrumLayout &layout,
                   float *intermediate)
        : m_lattice(lattice.size()), m_box(layout.box), m_size(layout.box.size()),
          m_padded(layout.padded), m_intermediate(intermediate), m_cellMm3(lattice.cellVolumeMm3()),
          m_blocks(blocksOf(layout.padded)), m_rowCells(std::size_t(m_blocks) * stripLanes),
          m_hx(premultiplier(layout.kernels[0], m_size.i, m_padded.i)),
          m_hy(premultiplier(layout.kernels[1], m_size.j, m_padded.j)),
          m_hz(premultiplier(layout.kernels[2], m_size.k, m_padded.k)), m_alongX(m_padded.i),
          m_alongY(m_padded.j), m_planeSums(std::size_t(m_size.k)), m_realRows(m_padded.i),
          m_planes(std::size_t(m_size.j) * m_rowCells),
          m_strips((std::size_t(m_size.j) + 2 * std::size_t(m_padded.j)) * stripFloats) {}

    // Transforms plane k of the box. Thread-safe.
    template <class T> void run(const T *samples, int k) {
        Complex *const plane = m_planes.local();
        transformAlongX(samples, k, plane);
        transformAlongY(plane, k);
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

    template <class T> void transformAlongX(const T *samples, int k, Complex *plane) {
        float *const real = m_realRows.local();
        std::fill(real, real + m_padded.i, 0.0F);
        const auto cell = float(m_cellMm3);
        PlaneSums sums;
        for (int j = 0; j < m_size.j; ++j) {
            const T *const in =
                samples + m_lattice.offsetOf(m_box.lo.i, j + m_box.lo.j, k + m_box.lo.k);
            sums.magnitudes += double(placeRow(in, cell * m_hz[k] * m_hy[j], real));
            addRow(in, j, sums);
            Complex *const row = plane + std::size_t(j) * m_rowCells;
            m_alongX.run(real, row);
            std::fill(row + m_padded.i / 2 + 1, row + m_rowCells, Complex());
        }
        m_planeSums[std::size_t(k)] = sums;
    }

    // Returns the sum of the magnitudes.
    template <class T> float placeRow(const T *in, float factor, float *real) const {
        const int middle = m_size.i / 2;
        const float *const hx = m_hx.data();
        float *const negative = real + m_padded.i - middle;
        float sum = 0.0F;
        for (int i = 0; i < middle; ++i) {
            negative[i] = float(in[i]) * factor * hx[i];
            sum += std::abs(negative[i]);
        }
        for (int i = middle; i < m_size.i; ++i) {
            real[i - middle] = float(in[i]) * factor * hx[i];
            sum += std::abs(real[i - middle]);
        }
        return sum;
    }

    template <class T> void addRow(const T *in, int j, PlaneSums &sums) const {
        const int middle = m_size.i / 2;
        double sum = 0.0, moment = 0.0;
        for (int i = 0; i < m_size.i; ++i) {
            sum += double(in[i]);
            moment += double(in[i]) * (i - middle);
        }
        sums.all += sum;
        sums.alongI += moment;
        sums.alongJ += sum * (j - m_size.j / 2);
    }

    void transformAlongY(const Complex *plane, int k) {
        float *const placed = m_strips.local();
        float *const column = placed + std::size_t(m_size.j) * stripFloats;
        float *const scratch = column + std::size_t(m_padded.j) * stripFloats;
        for (int block = 0; block < m_blocks; ++block) {
            for (int j = 0; j < m_size.j; ++j)
                loadExchanged(plane + std::size_t(j) * m_rowCells + block * stripLanes,
                              placed + std::size_t(j) * stripFloats);
            placeStrips(placed, m_size.j, column, m_padded.j);
            const float *const result = m_alongY.run(column, scratch);
            for (int y = 0; y < m_padded.j; ++y)
                std::memcpy(m_intermediate +
                                ((std::size_t(y) * m_blocks + block) * m_size.k + k) * stripFloats,
                            result + std::size_t(y) * stripFloats, stripFloats * sizeof(float));
        }
    }

    GridSize m_lattice;
    volume::VoxelBox m_box;
    GridSize m_size, m_padded;
    float *m_intermediate;
    double m_cellMm3;
    int m_blocks; ///< blocks of 16 x
    std::size_t m_rowCells;
    std::vector<float> m_hx, m_hy, m_hz;
    ForwardTransform1d m_alongX;
    StripTransform m_alongY;
    std::vector<PlaneSums> m_planeSums;
    Scratch<float> m_realRows;
    Scratch<Complex> m_planes;
    Scratch<float> m_strips;
};

// The transform along z of the rows y and -y, which contain each other's cells beyond the half, and
// their lines in the final layout.
template <class Cell> class RowPair {
public:
    RowPair(const SpectrumLayout &layout, const CellLayout &cells, const float *intermediate,
            const CellOutput &out)
        : m_layout(layout), m_cells(cells), m_transform(layout.padded.k),
          m_intermediate(intermediate), m_out(out),
          m_rowCells(std::size_t(cells.step) * (cells.columns - 1) + 2 * CellLayout::columnCells +
                     std::size_t(cells.halo)),
          m_strips(2 * std::size_t(layout.padded.k) * stripFloats),
          m_rows(2 * std::size_t(layout.padded.k) * m_rowCells) {}

    void run(int y) {
        const GridSize padded = m_layout.padded;
        const int mirrored = (padded.j - y) % padded.j;
        Cell *const first = m_rows.local();
        Cell *const second = mirrored == y ? first : first + std::size_t(padded.k) * m_rowCells;
        transformRow(y, first);
        if (second != first)
            transformRow(mirrored, second);
        addHalo(first, second);
        if (second != first)
            addHalo(second, first);
        writeLines(y, first);
        if (second != first)
            writeLines(mirrored, second);
    }

private:
    void transformRow(int y, Cell *rows) {
        const int depth = m_layout.box.size().k, padded = m_layout.padded.k;
        float *const strips = m_strips.local();
        float *const scratch = strips + std::size_t(padded) * stripFloats;
        const int blocks = blocksOf(m_layout.padded);
        for (int block = 0; block < blocks; ++block) {
            placeStrips(m_intermediate + (std::size_t(y) * blocks + block) * depth * stripFloats,
                        depth, strips, padded);
            const float *const result = m_transform.run(strips, scratch);
            storeExchanged(result, padded, m_out.scale, rows + m_cells.halo + block * stripLanes,
                           m_rowCells);
            if (block == 0)
                keepRounding(y, result, rows);
        }
    }

    // Each row has its own range of the output.
    void keepRounding(int y, const float *exact, const Cell *rows) const {
        constexpr int reach = Spectrum::roundingReach, side = 2 * reach + 1;
        const int q = y <= m_layout.padded.j / 2 ? y : y - m_layout.padded.j;
        if (m_out.rounding == nullptr || std::abs(q) > reach)
            return;
        for (int r = -reach; r <= reach; ++r) {
            const int z = modulo(r, m_layout.padded.k);
            for (int p = 0; p <= reach; ++p) {
                const float *const cell = exact + std::size_t(z) * stripFloats + p;
                const std::complex<float> stored =
                    asComplex(rows[std::size_t(z) * m_rowCells + m_cells.halo + p]);
                // Real and imaginary parts are swapped.
                m_out.rounding[((q + reach) * side + r + reach) * (reach + 1) + p] =
                    stored - m_out.scale * std::complex<float>(cell[stripLanes], cell[0]);
            }
        }
    }

    // F(-s) = conj F(s) gives the cells to the left and right of the half.
    void addHalo(Cell *rows, const Cell *mirrored) const {
        const int half = m_layout.padded.i / 2, depth = m_layout.padded.k, halo = m_cells.halo;
        for (int z = 0; z < depth; ++z) {
            Cell *const row = rows + std::size_t(z) * m_rowCells + halo;
            const Cell *const other =
                mirrored + std::size_t((depth - z) % depth) * m_rowCells + halo;
            for (int m = 1; m <= halo; ++m) {
                row[-m] = conjugate(other[m]);
                row[half + m] = conjugate(other[half - m]);
            }
            std::fill(row + half + halo + 1, row - halo + m_rowCells, Cell());
        }
    }

    void writeLines(int y, const Cell *rows) const {
        constexpr std::size_t lineBytes = CellLayout::columnCells * sizeof(Cell);
        for (int row = modulo(y - m_cells.firstY, m_layout.padded.j); row < m_cells.rows;
             row += m_layout.padded.j)
            for (int column = 0; column < m_cells.columns; ++column)
                for (int plane = 0; plane < m_cells.planes; ++plane) {
                    const int z = modulo(plane + m_cells.firstZ, m_layout.padded.k);
                    const std::size_t line = m_cells.line(column, plane, row);
                    streamLine(rows + std::size_t(z) * m_rowCells +
                                   std::size_t(column) * m_cells.step,
                               m_out.cells + line * lineBytes, lineBytes);
                }
        finishStreaming();
    }

    const SpectrumLayout &m_layout;
    const CellLayout &m_cells;
    StripTransform m_transform;
    const float *m_intermediate;
    CellOutput m_out;
    std::size_t m_rowCells;
    Scratch<float> m_strips;
    Scratch<Cell> m_rows;
};

template <class Cell>
void transformAllRows(const SpectrumLayout &layout, const CellLayout &cells,
                      const float *intermediate, const CellOutput &out,
                      const task::Progress &progress) {
    RowPair<Cell> rowPair(layout, cells, intermediate, out);
    tbb::parallel_for(0, layout.padded.j / 2 + 1, [&](int y) {
        progress.check();
        rowPair.run(y);
    });
}

} // namespace

std::size_t intermediateBytes(const SpectrumLayout &layout) {
    return std::size_t(layout.padded.j) * blocksOf(layout.padded) * layout.box.size().k *
           stripFloats * sizeof(float);
}

FieldSums transformPlanes(const volume::Volume &field, const SpectrumLayout &layout,
                          float *intermediate, const task::Progress &progress) {
    PlaneTransform planes(field.lattice(), layout, intermediate);
    field.visit([&](auto samples) {
        tbb::parallel_for(0, layout.box.size().k, [&](int k) {
            progress.check();
            planes.run(samples.data(), k);
        });
    });
    return planes.sums();
}

void transformRows(const SpectrumLayout &layout, const CellLayout &cells, const float *intermediate,
                   const CellOutput &out, const task::Progress &progress) {
    if (layout.storage == Storage::binary16)
        transformAllRows<std::uint32_t>(layout, cells, intermediate, out, progress);
    else
        transformAllRows<Complex>(layout, cells, intermediate, out, progress);
}

} // namespace pellucid::fourier
