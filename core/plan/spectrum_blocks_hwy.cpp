// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/plan/spectrum_blocks_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <hwy/highway.h>

#include "core/plan/spectrum_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::plan::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#include "core/fourier/cells_hwy.inc"

using Tag = hn::CappedTag<float, 16>;
constexpr int side = fourier::CellLayout::planesTogether;
constexpr std::size_t floatsPerLine = 2 * fourier::CellLayout::columnCells;

// The largest sum of |F|^2 over 2 x 2 x 2 cells of a block, and the brightest of these cells.
struct Brightest {
    float sum = 0.0F;
    int x = 0, y = 0, z = 0;
};

template <class Cell> float energyOf(const Cell *cell) {
    const hn::FixedTag<float, 2> pair;
    const auto value = loadCells(pair, cell);
    return hn::GetLane(hn::SumOfLanes(pair, hn::Mul(value, value)));
}

template <class Cell>
Brightest brightestCells(const Cell *cells, const fourier::CellLayout &layout, int column,
                         int plane, int row, int rows, int step) {
    const Tag d;
    constexpr std::size_t lanes = hn::MaxLanes(Tag());
    HWY_ALIGN float sums[floatsPerLine];
    Brightest brightest{0.0F, column * step, row, plane * side};
    for (int y = 0; y + 1 < rows; y += 2)
        for (int z = 0; z < side; z += 2) {
            for (std::size_t at = 0; at < floatsPerLine; at += lanes) {
                auto sum = hn::Zero(d);
                for (int n = 0; n < 4; ++n) {
                    const std::size_t line =
                        layout.line(column, plane * side + z + n % 2, row + y + n / 2);
                    const auto value =
                        loadCells(d, cells + line * fourier::CellLayout::columnCells + at / 2);
                    sum = hn::MulAdd(value, value, sum);
                }
                hn::Store(sum, d, sums + at);
            }
            for (int x = 0; x < step; x += 2) {
                const float sum =
                    (sums[2 * x] + sums[2 * x + 1]) + (sums[2 * x + 2] + sums[2 * x + 3]);
                if (sum > brightest.sum)
                    brightest = {sum, column * step + x, row + y, plane * side + z};
            }
        }
    const Brightest first = brightest;
    float most = 0.0F;
    for (int n = 0; n < 8; ++n) {
        const int x = n % 2, y = n / 2 % 2, z = n / 4;
        if (first.y + y >= row + rows)
            continue;
        const std::size_t line = layout.line(column, first.z + z, first.y + y);
        const float energy = energyOf(cells + line * fourier::CellLayout::columnCells +
                                      std::size_t(first.x - column * step + x));
        if (energy > most) {
            most = energy;
            brightest = {first.sum, first.x + x, first.y + y, first.z + z};
        }
    }
    return brightest;
}

// What the widths read at a point, by entry.
struct Readings {
    HWY_ALIGN float re[SpectrumBlocks::PointWeights::entries];
    HWY_ALIGN float im[SpectrumBlocks::PointWeights::entries];
};

// Calls `add` with each line of cells around a point, from its first tap on, and the indices of the
// taps along y and z. *Shape*: x, y and z are indices of the first tap, from the first cell.
template <class Cell, class Add>
HWY_INLINE void visitLines(const Cell *cells, const fourier::CellLayout &layout, int widest, int x,
                           int y, int z, const Add &add) {
    const int columns = (layout.columns - 1) * layout.step + fourier::CellLayout::columnCells;
    x = std::clamp(x, 0, columns - widest);
    y = std::clamp(y, 0, layout.rows - widest);
    z = std::clamp(z, 0, layout.planes - widest);
    const int column = std::min(x / layout.step, layout.columns - 1);
    const std::size_t inLine = std::size_t(x - column * layout.step);
    for (int k = 0; k < widest; ++k)
        for (int j = 0; j < widest; ++j)
            add(cells + layout.line(column, z + k, y + j) * fourier::CellLayout::columnCells +
                    inLine,
                std::size_t(j), std::size_t(k));
}

// The widths in lanes of their own.
template <class Cell>
void readWidths(const Cell *cells, const fourier::CellLayout &layout, int widest, int x, int y,
                int z, const SpectrumBlocks::PointWeights &weights, Readings &readings) {
    using Entries = hn::CappedTag<float, SpectrumBlocks::PointWeights::entries>;
    const Entries e;
    constexpr std::size_t lanes = hn::MaxLanes(Entries());
    const hn::FixedTag<float, 2> pair;
    HWY_ALIGN float line[2 * fourier::Kernel::largestWidth];
    for (std::size_t v = 0; v < SpectrumBlocks::PointWeights::entries; v += lanes) {
        auto re = hn::Zero(e), im = re;
        visitLines(cells, layout, widest, x, y, z,
                   [&](const Cell *from, std::size_t j, std::size_t k) HWY_ATTR {
                       auto rowRe = hn::Zero(e), rowIm = rowRe;
                       for (std::size_t i = 0; i < std::size_t(widest); ++i) {
                           hn::Store(loadCells(pair, from + i), pair, line + 2 * i);
                           const auto weight = hn::Load(e, weights.axis[0][i].data() + v);
                           rowRe = hn::MulAdd(weight, hn::Set(e, line[2 * i]), rowRe);
                           rowIm = hn::MulAdd(weight, hn::Set(e, line[2 * i + 1]), rowIm);
                       }
                       const auto weight = hn::Mul(hn::Load(e, weights.axis[1][j].data() + v),
                                                   hn::Load(e, weights.axis[2][k].data() + v));
                       re = hn::MulAdd(weight, rowRe, re);
                       im = hn::MulAdd(weight, rowIm, im);
                   });
        hn::Store(re, e, readings.re + v);
        hn::Store(im, e, readings.im + v);
    }
}

#if HWY_MAX_BYTES >= 32
// The widths 2 to 5 alone, real and imaginary parts side by side, in half as many instructions.
// Width 0 reads nothing.
template <class Cell>
void readWidthsTo5(const Cell *cells, const fourier::CellLayout &layout, int widest, int x, int y,
                   int z, const SpectrumBlocks::PointWeights &weights, Readings &readings) {
    const hn::FixedTag<float, 8> d;
    const hn::FixedTag<float, 4> four;
    const auto twice = [&](const float *entries) HWY_ATTR {
        const auto once = hn::LoadU(four, entries + SpectrumBlocks::entryOf(2));
        return hn::Combine(d, once, once);
    };
    HWY_ALIGN float all[8];
    constexpr int loaded = 4; // cells in a vector
    using Vector = hn::Vec<hn::FixedTag<float, 8>>;
    decltype(hn::SetTableIndices(d, static_cast<const std::int32_t *>(nullptr))) both[loaded];
    for (std::int32_t i = 0; i < loaded; ++i) {
        const std::int32_t re = 2 * i, im = re + 1;
        HWY_ALIGN const std::int32_t lanes[8] = {re, re, re, re, im, im, im, im};
        both[i] = hn::SetTableIndices(d, lanes);
    }
    Vector along[fourier::Kernel::largestWidth];
    for (int i = 0; i < widest; ++i)
        along[i] = twice(weights.axis[0][std::size_t(i)].data());
    auto sum = hn::Zero(d);
    visitLines(cells, layout, widest, x, y, z,
               [&](const Cell *from, std::size_t j, std::size_t k) HWY_ATTR {
                   auto row = hn::Zero(d);
                   for (int first = 0; first < widest; first += loaded) {
                       // Up to three cells beyond the taps: of the next line, or of the 64 readable
                       // bytes after the last.
                       const auto values = loadCells(d, from + first);
                       for (int i = 0; i < std::min(loaded, widest - first); ++i)
                           row = hn::MulAdd(along[first + i], hn::TableLookupLanes(values, both[i]),
                                            row);
                   }
                   const auto weight =
                       hn::Mul(twice(weights.axis[1][j].data()), twice(weights.axis[2][k].data()));
                   sum = hn::MulAdd(weight, row, sum);
               });
    hn::Store(sum, d, all);
    readings = {};
    std::copy_n(all, 4, readings.re + SpectrumBlocks::entryOf(2));
    std::copy_n(all + 4, 4, readings.im + SpectrumBlocks::entryOf(2));
}
#endif

// The squared errors of the widths at a point, by entry. Every path adds in the same order.
template <class Cell>
void errorsAt(const Cell *cells, const fourier::CellLayout &layout, int widest, int x, int y, int z,
              const SpectrumBlocks::PointWeights &weights, float *errors) {
    Readings readings;
#if HWY_MAX_BYTES >= 32
    if (widest <= 5)
        readWidthsTo5(cells, layout, widest, x, y, z, weights, readings);
    else
        readWidths(cells, layout, widest, x, y, z, weights, readings);
#else
    readWidths(cells, layout, widest, x, y, z, weights, readings);
#endif
    const auto own = std::size_t(SpectrumBlocks::entryOf(widest));
    for (std::size_t n = 0; n < SpectrumBlocks::PointWeights::entries; ++n)
        errors[n] = (readings.re[n] - readings.re[own]) * (readings.re[n] - readings.re[own]) +
                    (readings.im[n] - readings.im[own]) * (readings.im[n] - readings.im[own]);
}

// Errors by entry at a block's brightest cells, and elsewhere in the block.
template <class Cell>
void measureBlock(const Cell *cells, const fourier::CellLayout &layout, const Brightest &brightest,
                  int column, int plane, int row, float scale, const SpectrumBlocks &blocks,
                  float *entries) {
    constexpr std::size_t count = SpectrumBlocks::PointWeights::entries;
    constexpr std::size_t elsewhere = 3;
    const int widest = blocks.widest, before = widest / 2;
    float found[count], most[count] = {}, sums[count] = {};
    for (std::size_t n = 0; n < SpectrumBlocks::pointsInPhase; ++n) {
        errorsAt(cells, layout, widest, brightest.x - before, brightest.y - before,
                 brightest.z - before, blocks.points[n], found);
        for (std::size_t w = 0; w < count; ++w)
            most[w] = std::max(most[w], 0.5F * found[w]);
    }
    // Any places will do that neighbouring blocks do not share.
    auto seed = std::uint32_t((column * 2654435761U) ^ (plane * 2246822519U) ^ (row * 3266489917U));
    for (std::size_t n = 0; n < elsewhere; ++n) {
        seed = seed * 1664525U + 1013904223U;
        const int x = int((seed >> 8) % std::uint32_t(blocks.step)), y = int((seed >> 20) % side),
                  z = int((seed >> 26) % side);
        const std::size_t point =
            SpectrumBlocks::pointsInPhase +
            (seed >> 12) % (SpectrumBlocks::pointCount - SpectrumBlocks::pointsInPhase);
        errorsAt(cells, layout, widest, column * blocks.step + x - before, row + y - before,
                 plane * side + z - before, blocks.points[point], found);
        for (std::size_t w = 0; w < count; ++w)
            sums[w] += found[w] / float(elsewhere);
    }
    for (std::size_t w = 0; w < std::size_t(blocks.entries); ++w)
        entries[w] = scale * std::max(most[w], sums[w]);
}

template <class Cell>
void measureWith(const fourier::Spectrum &spectrum, int column, int plane, float dark,
                 SpectrumBlocks &blocks) {
    const fourier::CellLayout &layout = spectrum.cellLayout();
    const auto *const cells = reinterpret_cast<const Cell *>(spectrum.cells());
    const auto scale = float(spectrum.unit() * spectrum.unit());
    for (int block = 0; block < blocks.rows; ++block) {
        const int row = side * block, rows = std::min(side, layout.rows - row);
        const Brightest brightest =
            brightestCells(cells, layout, column, plane, row, rows, blocks.step);
        const std::size_t at =
            (std::size_t(plane) * blocks.rows + block) * blocks.columns + std::size_t(column);
        float *const entries = blocks.errors.data() + at * std::size_t(blocks.entries);
        if (scale * brightest.sum <= dark)
            std::fill_n(entries, blocks.entries, scale * brightest.sum);
        else
            measureBlock(cells, layout, brightest, column, plane, row, scale, blocks, entries);
    }
}

void measure(const fourier::Spectrum &spectrum, int column, int plane, float dark,
             SpectrumBlocks &blocks) {
    if (spectrum.layout().storage == fourier::Storage::binary16)
        measureWith<Half>(spectrum, column, plane, dark, blocks);
    else
        measureWith<std::complex<float>>(spectrum, column, plane, dark, blocks);
}

// The compiler is told not to fuse multiplications and additions in this file; vectors of any
// length then compute the same.
void addPoints(const PointSum &sum, float *errors) {
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    const SpectrumBlocks &blocks = *sum.blocks;
    const std::int32_t counts[3] = {blocks.columns, blocks.rows, blocks.planes};
    const float sizes[3] = {float(blocks.step), float(side), float(side)};
    const auto half = hn::Set(d, 0.5F);
    HWY_ALIGN float factors[16];
    HWY_ALIGN std::int32_t indices[16];
    const hn::CappedTag<float, 4> four;
    constexpr std::size_t lanesOfFour = hn::MaxLanes(hn::CappedTag<float, 4>());
    const auto entries = std::size_t(blocks.entries);
    HWY_ALIGN float sums[SpectrumBlocks::PointWeights::entries] = {};
    for (std::size_t from = 0; from < sum.count; from += hn::Lanes(d)) {
        auto factor = hn::Set(d, 1.0F);
        hn::Vec<Tag> cell[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto padded = hn::Set(d, sum.padded[axis]);
            const auto at =
                hn::Add(hn::LoadU(d, sum.cells[axis] + from), hn::Set(d, sum.first[axis]));
            const auto cycles = hn::Mul(at, hn::Set(d, 1.0F / sum.padded[axis]));
            const auto least =
                hn::Max(hn::Zero(d), hn::Sub(hn::Abs(cycles), hn::Set(d, sum.reach[axis])));
            const auto entry =
                hn::Min(hn::Set(di, sum.lastFactor),
                        hn::ConvertTo(di, hn::Mul(least, hn::Set(d, sum.factorsPerCycle))));
            factor = hn::Mul(factor, hn::GatherIndex(d, sum.factors, entry));
            cell[axis] = hn::Sub(at, hn::Mul(hn::Round(cycles), padded));
        }
        // The half with negative x mirrors the other.
        const auto mirrored = hn::Lt(cell[0], hn::Zero(d));
        auto index = hn::Zero(di);
        for (std::size_t axis = 3; axis-- > 0;) {
            const auto at = hn::IfThenElse(mirrored, hn::Neg(cell[axis]), cell[axis]);
            const auto block = hn::ConvertTo(
                di, hn::Mul(hn::Add(hn::Sub(at, hn::Set(d, blocks.firstCell[axis])), half),
                            hn::Set(d, 1.0F / sizes[axis])));
            const auto inside =
                hn::Min(hn::Set(di, counts[axis] - 1), hn::Max(hn::Zero(di), block));
            index = hn::Add(hn::Mul(index, hn::Set(di, counts[axis])), inside);
        }
        hn::Store(factor, d, factors);
        hn::Store(index, di, indices);
        const std::size_t count = std::min(hn::Lanes(d), sum.count - from);
        for (std::size_t n = 0; n < count; ++n) {
            const float *const of = blocks.errors.data() + std::size_t(indices[n]) * entries;
            const auto weight = hn::Set(four, factors[n]);
            for (std::size_t e = 0; e < entries; e += lanesOfFour) {
                const auto error = hn::Mul(weight, hn::LoadU(four, of + e));
                const auto before = hn::Load(four, sums + e);
                hn::Store(sum.takesLargest ? hn::Max(before, error) : hn::Add(before, error), four,
                          sums + e);
            }
        }
    }
    for (std::size_t e = 0; e < entries; ++e)
        errors[e] += sums[e];
}

} // namespace pellucid::plan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::plan {

HWY_EXPORT(measure);
HWY_EXPORT(addPoints);

namespace {

// The weights at an offset c of the widest kernel's taps, by axis.
SpectrumBlocks::PointWeights weightsAt(const fourier::KernelsByWidth &kernels,
                                       const std::array<double, 3> &c) {
    SpectrumBlocks::PointWeights weights{};
    const int widest = kernels.widest();
    for (std::size_t d = 0; d < 3; ++d)
        for (int width = fourier::KernelsByWidth::narrowest; width <= widest; ++width) {
            const fourier::Kernel &kernel = kernels.of(width)[d];
            const double at = 0.5 * (widest - 1) - c[d]; // from the first tap of the widest
            const int first = int(std::ceil(at - 0.5 * width));
            for (int k = 0; k < width; ++k)
                weights
                    .axis[d][std::size_t(first + k)][std::size_t(SpectrumBlocks::entryOf(width))] =
                    float(kernel.value(first + k - at));
        }
    return weights;
}

} // namespace

SpectrumBlocks::SpectrumBlocks(const fourier::Spectrum &spectrum,
                               const fourier::KernelsByWidth &kernels)
    : widest(kernels.widest()), entries(widest <= 5 ? 4 : 8) {
    const fourier::CellLayout &layout = spectrum.cellLayout();
    step = layout.step;
    columns = layout.columns;
    rows = (layout.rows + fourier::CellLayout::planesTogether - 1) /
           fourier::CellLayout::planesTogether;
    planes = layout.planes / fourier::CellLayout::planesTogether;
    firstCell = {float(layout.firstX), float(layout.firstY), float(layout.firstZ)};
    errors.resize(std::size_t(columns) * rows * planes * std::size_t(entries));
    // On the grid, the first tap of an even width is on the edge of the kernel.
    const double onGrid = widest % 2 == 0 ? -0.5 : 0.0, halfway = -0.5 - onGrid;
    points[0] = weightsAt(kernels, {onGrid, onGrid, onGrid});
    points[1] = weightsAt(kernels, {halfway, onGrid, onGrid});
    points[2] = weightsAt(kernels, {onGrid, halfway, onGrid});
    points[3] = weightsAt(kernels, {onGrid, onGrid, halfway});
    points[4] = weightsAt(kernels, {halfway, halfway, halfway});
    for (std::size_t n = pointsInPhase; n < pointCount; ++n) {
        std::array<double, 3> c{};
        // Additive recurrences fill the cell evenly.
        for (std::size_t d = 0; d < 3; ++d) {
            constexpr std::array<double, 3> steps{0.8191725, 0.6710436, 0.5497005};
            const double turns = 0.25 + double(n) * steps[d];
            c[d] = turns - std::floor(turns) - 0.5;
        }
        points[n] = weightsAt(kernels, c);
    }
}

void measureBlocks(const fourier::Spectrum &spectrum, int column, int plane, float dark,
                   SpectrumBlocks &blocks) {
    HWY_DYNAMIC_DISPATCH(measure)(spectrum, column, plane, dark, blocks);
}

void sumErrors(const PointSum &sum, float *errors) {
    HWY_DYNAMIC_DISPATCH(addPoints)(sum, errors);
}

} // namespace pellucid::plan
#endif
