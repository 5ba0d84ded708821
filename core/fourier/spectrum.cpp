// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

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

// Scratch that each thread keeps; uninitialised, 64-byte aligned.
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

// The field after the transforms along x and y: [y][block of 16 x][k][strip], so that the transform
// along z reads one run. Planes of the field only: the padding along z is zero.
std::size_t intermediateBytes(const SpectrumLayout &layout) {
    return std::size_t(layout.padded.j) * blocksOf(layout.padded) * layout.box.size().k *
           stripFloats * sizeof(float);
}

// 1/h along one axis for the samples of the box, the wrap voxel being the middle one.
std::vector<float> premultiplier(const Kernel &kernel, int samples, int padded) {
    std::vector<float> factors(samples);
    for (int n = 0; n < samples; ++n)
        factors[n] = float(1.0 / kernel.apodisation(double(n - samples / 2) / padded));
    return factors;
}

int modulo(int index, int period) {
    return (index % period + period) % period;
}

// Fills strips with those of `from`, the middle one at index 0, and zero between.
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

// The transform along z of the rows y and -y, which give each other's cells beyond the half, and
// their lines in the final layout.
template <class Cell> class RowPair {
public:
    RowPair(const SpectrumLayout &layout, const CellLayout &cells, const StripTransform &transform,
            const float *intermediate, float scale, std::byte *out, std::complex<float> *rounding)
        : m_layout(layout), m_cells(cells), m_transform(transform), m_intermediate(intermediate),
          m_scale(scale), m_out(out), m_rounding(rounding),
          m_rowCells(std::size_t(cells.step) * (cells.columns - 1) + 2 * CellLayout::columnCells +
                     std::size_t(cells.apron)),
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
        addApron(first, second);
        if (second != first)
            addApron(second, first);
        writeLines(y, first);
        if (second != first)
            writeLines(mirrored, second);
    }

private:
    void transformRow(int y, Cell *rows) {
        const int depth = m_layout.box.size().k, padded = m_layout.padded.k;
        float *const strips = m_strips.local();
        float *const beside = strips + std::size_t(padded) * stripFloats;
        const int blocks = blocksOf(m_layout.padded);
        for (int block = 0; block < blocks; ++block) {
            placeStrips(m_intermediate + (std::size_t(y) * blocks + block) * depth * stripFloats,
                        depth, strips, padded);
            const float *const result = m_transform.run(strips, beside);
            storeExchanged(result, padded, m_scale, rows + m_cells.apron + block * stripLanes,
                           m_rowCells);
            if (block == 0)
                keepRounding(y, result, rows);
        }
    }

    // Each row has a place of its own.
    void keepRounding(int y, const float *exact, const Cell *rows) const {
        constexpr int reach = Spectrum::roundingReach, side = 2 * reach + 1;
        const int q = y <= m_layout.padded.j / 2 ? y : y - m_layout.padded.j;
        if (m_rounding == nullptr || std::abs(q) > reach)
            return;
        for (int r = -reach; r <= reach; ++r) {
            const int z = modulo(r, m_layout.padded.k);
            for (int p = 0; p <= reach; ++p) {
                const float *const of = exact + std::size_t(z) * stripFloats + p;
                const std::complex<float> stored =
                    asComplex(rows[std::size_t(z) * m_rowCells + m_cells.apron + p]);
                m_rounding[((q + reach) * side + r + reach) * (reach + 1) + p] =
                    stored -
                    m_scale * std::complex<float>(of[stripLanes], of[0]); // they are exchanged
            }
        }
    }

    // F(-s) = conj F(s) gives the cells left of the half and right of it.
    void addApron(Cell *rows, const Cell *mirrored) const {
        const int half = m_layout.padded.i / 2, depth = m_layout.padded.k, apron = m_cells.apron;
        for (int z = 0; z < depth; ++z) {
            Cell *const row = rows + std::size_t(z) * m_rowCells + apron;
            const Cell *const other =
                mirrored + std::size_t((depth - z) % depth) * m_rowCells + apron;
            for (int m = 1; m <= apron; ++m) {
                row[-m] = conjugate(other[m]);
                row[half + m] = conjugate(other[half - m]);
            }
            std::fill(row + half + apron + 1, row - apron + m_rowCells, Cell());
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
                               m_out + line * lineBytes, lineBytes);
                }
        finishStreaming();
    }

    const SpectrumLayout &m_layout;
    const CellLayout &m_cells;
    const StripTransform &m_transform;
    const float *m_intermediate;
    float m_scale;
    std::byte *m_out;
    std::complex<float> *m_rounding; ///< see Spectrum; none if nothing is rounded
    std::size_t m_rowCells;
    Scratch<float> m_strips;
    Scratch<Cell> m_rows;
};

} // namespace

CellLayout::CellLayout(const SpectrumLayout &layout)
    : apron(layout.width() / 2 + 1), step(columnCells + 1 - layout.width()),
      columns((layout.padded.i / 2 + 1 + 2 * apron - layout.width()) / step + 1),
      rows(layout.padded.j + 1 + 2 * apron),
      planes((layout.padded.k + 2 * apron + planesTogether) / planesTogether * planesTogether),
      firstX(-apron), firstY(-layout.padded.j / 2 - apron), firstZ(-layout.padded.k / 2 - apron) {}

bool SpectrumLayout::addressable() const {
    return CellLayout(*this).lines() < (std::size_t(1) << 32) / CellLayout::columnCells;
}

std::size_t SpectrumLayout::bytes() const {
    return CellLayout(*this).lines() * CellLayout::columnCells * bytesPerCell(storage) + 64;
}

std::size_t SpectrumLayout::peakBytes() const {
    return bytes() + intermediateBytes(*this);
}

Spectrum::Spectrum(const volume::Volume &field, const SpectrumLayout &layout)
    : m_lattice(field.lattice()), m_layout(layout), m_cellLayout(layout) {
    const volume::VoxelBox &box = layout.box;
    const GridSize size = box.size();
    m_wrapPoint = m_lattice.patient(
        volume::VoxelIndex{box.lo.i + size.i / 2, box.lo.j + size.j / 2, box.lo.k + size.k / 2});
    m_cells = system::allocatePages(layout.bytes(), task::because::aSpectrum);
    std::memset(m_cells.get() + layout.bytes() - 64, 0, 64);
}

Spectrum Spectrum::prepare(const volume::Volume &field, const SpectrumLayout &layout,
                           const task::Progress &progress) {
    assert(field.isFloat() && layout.addressable());
    Spectrum spectrum(field, layout);
    const GridSize lattice = field.lattice().size(), size = layout.box.size();
    const GridSize padded = layout.padded;
    const int blocks = blocksOf(padded), middleI = size.i / 2;
    const auto hx = premultiplier(layout.kernels[0], size.i, padded.i);
    const auto hy = premultiplier(layout.kernels[1], size.j, padded.j);
    const auto hz = premultiplier(layout.kernels[2], size.k, padded.k);
    const auto cell = float(field.lattice().cellVolumeMm3());

    // Along x and y plane by plane, which stays in the cache; rows and planes of padding are not
    // transformed. Sample n goes to (n - middle) modulo padded.
    const auto intermediateMemory =
        system::allocatePages(intermediateBytes(layout), task::because::aTransform);
    auto *const intermediate = reinterpret_cast<float *>(intermediateMemory.get());
    const ForwardTransform1d alongX(padded.i);
    const StripTransform alongY(padded.j), alongZ(padded.k);
    // The sum and the first moments about the wrap voxel.
    struct PlaneSums {
        double all = 0.0, alongI = 0.0, alongJ = 0.0;
    };
    std::vector<double> planeBounds(size.k);
    std::vector<PlaneSums> planeSums(size.k);
    const std::size_t rowCells = std::size_t(blocks) * stripLanes;
    Scratch<float> realRows(padded.i);
    Scratch<Complex> planes(size.j * rowCells);
    Scratch<float> strips((std::size_t(size.j) + 2 * padded.j) * stripFloats);
    field.visit([&](auto samples) {
        tbb::parallel_for(0, size.k, [&](int k) {
            progress.check();
            float *const real = realRows.local();
            Complex *const plane = planes.local();
            std::fill(real, real + padded.i, 0.0F);
            double planeBound = 0.0;
            PlaneSums sums;
            for (int j = 0; j < size.j; ++j) {
                const auto *in =
                    samples.data() +
                    (std::size_t(k + layout.box.lo.k) * lattice.j + j + layout.box.lo.j) *
                        lattice.i +
                    layout.box.lo.i;
                const float factor = cell * hz[k] * hy[j];
                float *const negative = real + padded.i - middleI;
                float sum = 0.0F;
                for (int i = 0; i < middleI; ++i) {
                    negative[i] = float(in[i]) * factor * hx[i];
                    sum += std::abs(negative[i]);
                }
                for (int i = middleI; i < size.i; ++i) {
                    real[i - middleI] = float(in[i]) * factor * hx[i];
                    sum += std::abs(real[i - middleI]);
                }
                planeBound += double(sum);
                double rowSum = 0.0, rowMoment = 0.0;
                for (int i = 0; i < size.i; ++i) {
                    rowSum += double(in[i]);
                    rowMoment += double(in[i]) * (i - middleI);
                }
                sums.all += rowSum;
                sums.alongI += rowMoment;
                sums.alongJ += rowSum * (j - size.j / 2);
                Complex *const row = plane + std::size_t(j) * rowCells;
                alongX.run(real, row);
                std::fill(row + padded.i / 2 + 1, row + rowCells, Complex());
            }
            planeBounds[k] = planeBound;
            planeSums[k] = sums;
            float *const placed = strips.local();
            float *const column = placed + std::size_t(size.j) * stripFloats;
            float *const beside = column + std::size_t(padded.j) * stripFloats;
            for (int block = 0; block < blocks; ++block) {
                for (int j = 0; j < size.j; ++j)
                    loadExchanged(plane + std::size_t(j) * rowCells + block * stripLanes,
                                  placed + std::size_t(j) * stripFloats);
                placeStrips(placed, size.j, column, padded.j);
                const float *const result = alongY.run(column, beside);
                for (int y = 0; y < padded.j; ++y)
                    std::memcpy(intermediate +
                                    ((std::size_t(y) * blocks + block) * size.k + k) * stripFloats,
                                result + std::size_t(y) * stripFloats, stripFloats * sizeof(float));
            }
        });
    });
    progress.report(0.5);

    const double dv = field.lattice().cellVolumeMm3();
    for (int k = 0; k < size.k; ++k) {
        const PlaneSums &sums = planeSums[k];
        spectrum.m_mass += dv * sums.all;
        spectrum.m_moments[0] += dv * sums.alongI;
        spectrum.m_moments[1] += dv * sums.alongJ;
        spectrum.m_moments[2] += dv * sums.all * (k - size.k / 2);
    }
    // No cell can exceed the sum of the magnitudes; a power of two scales without rounding.
    double scale = 1.0;
    if (layout.storage == Storage::binary16) {
        double bound = 0.0;
        for (const double plane : planeBounds)
            bound += plane;
        if (bound > 0.0)
            scale = std::exp2(std::floor(std::log2(32768.0 / bound)));
        spectrum.m_unit = 1.0 / scale;
    }
    const auto finish = [&](auto &&rowPair) {
        tbb::parallel_for(0, padded.j / 2 + 1, [&](int y) {
            progress.check();
            rowPair.run(y);
        });
    };
    constexpr std::size_t side = 2 * roundingReach + 1;
    const bool holdsReach = std::min({padded.i, padded.j, padded.k}) > int(side);
    if (layout.storage == Storage::binary16 && holdsReach)
        spectrum.m_rounding.resize(side * side * (roundingReach + 1));
    if (layout.storage == Storage::binary16)
        finish(RowPair<std::uint32_t>(layout, spectrum.m_cellLayout, alongZ, intermediate,
                                      float(scale), spectrum.m_cells.get(),
                                      holdsReach ? spectrum.m_rounding.data() : nullptr));
    else
        finish(RowPair<Complex>(layout, spectrum.m_cellLayout, alongZ, intermediate, 1.0F,
                                spectrum.m_cells.get(), nullptr));
    progress.report(1.0);
    return spectrum;
}

std::complex<double> Spectrum::value(int p, int q, int r) const {
    const CellLayout &c = m_cellLayout;
    const int x = p - c.firstX;
    const int column = std::min(x / c.step, c.columns - 1);
    const std::size_t line = c.line(column, r - c.firstZ, q - c.firstY);
    const std::size_t at = line * CellLayout::columnCells + std::size_t(x - column * c.step);
    if (m_layout.storage == Storage::float32)
        return std::complex<double>(reinterpret_cast<const Complex *>(m_cells.get())[at]);
    const std::uint32_t pair = reinterpret_cast<const std::uint32_t *>(m_cells.get())[at];
    return m_unit * std::complex<double>(fromBinary16(std::uint16_t(pair)),
                                         fromBinary16(std::uint16_t(pair >> 16)));
}

std::complex<double> Spectrum::rounding(int p, int q, int r) const {
    if (m_rounding.empty())
        return {};
    if (p < 0)
        return std::conj(rounding(-p, -q, -r));
    constexpr int side = 2 * roundingReach + 1;
    const int at = ((q + roundingReach) * side + r + roundingReach) * (roundingReach + 1) + p;
    return m_unit * std::complex<double>(m_rounding[std::size_t(at)]);
}

} // namespace pellucid::fourier
