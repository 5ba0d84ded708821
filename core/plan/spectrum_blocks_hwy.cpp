// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/plan/spectrum_blocks_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <hwy/highway.h>

#include "core/plan/spectrum_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace pellucid::plan::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#include "core/fourier/cells_hwy.inc"

using Tag = hn::CappedTag<float, 16>;
constexpr int side = fourier::CellLayout::planesTogether;
constexpr std::size_t floatsPerLine = 2 * fourier::CellLayout::columnCells;

// The largest sum of |F|^2 over 2 x 2 x 2 cells of a block.
template <class Cell>
float largestSum(const Cell *cells, const fourier::CellLayout &layout, int column, int plane,
                 int row, int rows, int step) {
    const Tag d;
    constexpr std::size_t lanes = hn::MaxLanes(Tag());
    HWY_ALIGN float sums[floatsPerLine];
    float largest = 0.0F;
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
            for (int x = 0; x + 1 < step; x += 2)
                largest = std::max(largest, (sums[2 * x] + sums[2 * x + 1]) +
                                                (sums[2 * x + 2] + sums[2 * x + 3]));
        }
    return largest;
}

template <class Cell>
void measureWith(const fourier::Spectrum &spectrum, int column, int plane, SpectrumBlocks &blocks) {
    const fourier::CellLayout &layout = spectrum.cellLayout();
    const auto *const cells = reinterpret_cast<const Cell *>(spectrum.cells());
    // Half the mean of eight cells, see SpectrumEnergies.
    const auto scale = float(spectrum.unit() * spectrum.unit() / 16.0);
    for (int block = 0; block < blocks.rows; ++block) {
        const int row = side * block, rows = std::min(side, layout.rows - row);
        blocks.energy[(std::size_t(plane) * blocks.rows + block) * blocks.columns + column] =
            scale * largestSum(cells, layout, column, plane, row, rows, blocks.step);
    }
}

void measure(const fourier::Spectrum &spectrum, int column, int plane, SpectrumBlocks &blocks) {
    if (spectrum.layout().storage == fourier::Storage::binary16)
        measureWith<Half>(spectrum, column, plane, blocks);
    else
        measureWith<std::complex<float>>(spectrum, column, plane, blocks);
}

void walk(const PlaneWalk &w, int v, float *rings) {
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    const std::size_t lanes = hn::Lanes(d);
    const SpectrumBlocks &b = *w.blocks;
    const float y = float(v) + 0.25F; // no point at frequency 0
    const auto half = hn::Set(d, 0.5F);
    HWY_ALIGN float energies[16];
    HWY_ALIGN std::int32_t ringOf[16];
    // Row 0 is its own mirror image.
    for (int u = v == 0 ? 0 : -w.countU; u <= w.countU; u += int(lanes)) {
        const auto x = hn::Iota(d, float(u) + 0.25F);
        const auto along = hn::Mul(x, hn::Set(d, w.stepU));
        const auto radius =
            hn::Sqrt(hn::MulAdd(along, along, hn::Set(d, y * w.stepV * y * w.stepV)));
        hn::Store(hn::ConvertTo(di, radius), di, ringOf);
        auto factor = hn::Set(d, 1.0F);
        hn::Vec<Tag> cell[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = hn::MulAdd(x, hn::Set(d, w.perU[axis]), hn::Set(d, y * w.perV[axis]));
            const auto cycles = hn::Mul(at, hn::Set(d, 1.0F / w.padded[axis]));
            const auto entry =
                hn::Min(hn::Set(di, w.lastFactor),
                        hn::NearestInt(hn::Mul(hn::Abs(cycles), hn::Set(d, w.factorsPerCycle))));
            factor = hn::Mul(factor, hn::GatherIndex(d, w.factors, entry));
            cell[axis] = hn::NegMulAdd(hn::Round(cycles), hn::Set(d, w.padded[axis]), at);
        }
        // The half with negative x mirrors the other.
        const auto mirrored = hn::Lt(cell[0], hn::Zero(d));
        auto index = hn::Zero(di);
        const std::int32_t counts[3] = {b.columns, b.rows, b.planes};
        for (int axis = 2; axis >= 0; --axis) {
            const auto at = hn::IfThenElse(mirrored, hn::Neg(cell[axis]), cell[axis]);
            const float size = axis == 0 ? float(b.step) : float(side);
            const auto block = hn::ConvertTo(
                di, hn::Mul(hn::Add(hn::Sub(at, hn::Set(d, b.firstCell[std::size_t(axis)])), half),
                            hn::Set(d, 1.0F / size)));
            const auto inside =
                hn::Min(hn::Set(di, counts[axis] - 1), hn::Max(hn::Zero(di), block));
            index = hn::Add(hn::Mul(index, hn::Set(di, counts[axis])), inside);
        }
        hn::Store(hn::Mul(factor, hn::GatherIndex(d, b.energy.data(), index)), d, energies);
        const std::size_t count = std::min<std::size_t>(lanes, std::size_t(w.countU - u + 1));
        for (std::size_t n = 0; n < count; ++n)
            if (ringOf[n] < w.rings)
                rings[ringOf[n]] += energies[n];
    }
}

} // namespace pellucid::plan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::plan {

HWY_EXPORT(measure);
HWY_EXPORT(walk);

SpectrumBlocks::SpectrumBlocks(const fourier::Spectrum &spectrum) {
    const fourier::CellLayout &layout = spectrum.cellLayout();
    step = layout.step;
    columns = layout.columns;
    rows = (layout.rows + fourier::CellLayout::planesTogether - 1) /
           fourier::CellLayout::planesTogether;
    planes = layout.planes / fourier::CellLayout::planesTogether;
    firstCell = {float(layout.firstX), float(layout.firstY), float(layout.firstZ)};
    energy.resize(std::size_t(columns) * rows * planes);
}

void measureBlocks(const fourier::Spectrum &spectrum, int column, int plane,
                   SpectrumBlocks &blocks) {
    HWY_DYNAMIC_DISPATCH(measure)(spectrum, column, plane, blocks);
}

void walkRow(const PlaneWalk &w, int v, float *rings) {
    HWY_DYNAMIC_DISPATCH(walk)(w, v, rings);
}

} // namespace pellucid::plan
#endif
