// SPDX-License-Identifier: GPL-3.0-or-later
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/widths/block_energies_hwy.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <algorithm>
#include <complex>
#include <cstdint>
#include <hwy/highway.h>
#include <numeric>

#include <tbb/parallel_for.h>

#include "core/task/error.h"
#include "core/widths/block_energies.h"
#include "core/widths/reasons.h"

// The compiler is told not to fuse multiplications and additions in this file: every instruction
// set computes the same energies and draws the same lines.
HWY_BEFORE_NAMESPACE();
namespace pellucid::widths::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
#include "core/fourier/cells_hwy.inc"

using Tag = hn::CappedTag<float, 16>;
constexpr int side = BlockEnergies::side;

// The mean energies of the blocks of one column and group of planes.
template <class Cell>
void addUp(const fourier::Spectrum &spectrum, int column, int group, BlockEnergies::Table &table) {
    constexpr std::size_t floatsPerLine = 2 * fourier::CellLayout::columnCells;
    const Tag d;
    const fourier::CellLayout &layout = spectrum.cellLayout();
    const auto *const cells = reinterpret_cast<const Cell *>(spectrum.cells());
    const auto scale = float(spectrum.unit() * spectrum.unit());
    for (int block = 0; block < table.rows; ++block) {
        const int first = side * block, last = std::min(first + side, layout.rows);
        HWY_ALIGN float sums[floatsPerLine] = {};
        for (int row = first; row < last; ++row)
            for (int plane = group * side; plane < (group + 1) * side; ++plane) {
                const Cell *const line =
                    cells + layout.line(column, plane, row) * fourier::CellLayout::columnCells;
                for (std::size_t at = 0; at < floatsPerLine; at += hn::Lanes(d)) {
                    const auto value = loadCells(d, line + at / 2);
                    hn::Store(hn::Add(hn::Load(d, sums + at), hn::Mul(value, value)), d, sums + at);
                }
            }
        // Columns overlap beyond their step.
        const float sum = std::accumulate(sums, sums + std::ptrdiff_t(2) * table.step, 0.0F);
        table.energies[(std::size_t(group) * std::size_t(table.rows) + std::size_t(block)) *
                           std::size_t(table.columns) +
                       std::size_t(column)] =
            scale * sum / float(table.step * side * (last - first));
    }
}

void addUpBlocks(const fourier::Spectrum &spectrum, int column, int group,
                 BlockEnergies::Table &table) {
    if (spectrum.layout().storage == fourier::Storage::binary16)
        addUp<Half>(spectrum, column, group, table);
    else
        addUp<std::complex<float>>(spectrum, column, group, table);
}

float meanOf(const BlockEnergies::Table &table, const float *first,
             const BlockEnergies::Points &points) {
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    const std::int32_t counts[3] = {table.columns, table.rows, table.planes};
    const float sizes[3] = {float(table.step), float(side), float(side)};
    HWY_ALIGN float energies[BlockEnergies::pointCount];
    for (std::size_t n = 0; n < BlockEnergies::pointCount; n += hn::Lanes(d)) {
        hn::Vec<Tag> cell[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto padded = hn::Set(d, table.padded[axis]);
            const auto at =
                hn::Add(hn::Load(d, points.cells[axis].data() + n), hn::Set(d, first[axis]));
            const auto turns = hn::Round(hn::Mul(at, hn::Set(d, 1.0F / table.padded[axis])));
            cell[axis] = hn::Sub(at, hn::Mul(turns, padded));
        }
        // The half with negative x mirrors the other.
        const auto mirrored = hn::Lt(cell[0], hn::Zero(d));
        auto index = hn::Zero(di);
        for (std::size_t axis = 3; axis-- > 0;) {
            const auto at = hn::IfThenElse(mirrored, hn::Neg(cell[axis]), cell[axis]);
            const auto block =
                hn::ConvertTo(di, hn::Mul(hn::Sub(at, hn::Set(d, table.firstCell[axis] - 0.5F)),
                                          hn::Set(d, 1.0F / sizes[axis])));
            const auto inside =
                hn::Min(hn::Set(di, counts[axis] - 1), hn::Max(hn::Zero(di), block));
            index = hn::Add(hn::Mul(index, hn::Set(di, counts[axis])), inside);
        }
        hn::Store(hn::GatherIndex(d, table.energies.data(), index), d, energies + n);
    }
    return std::accumulate(std::begin(energies), std::end(energies), 0.0F) /
           float(BlockEnergies::pointCount);
}

} // namespace pellucid::widths::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pellucid::widths {

HWY_EXPORT(addUpBlocks);
HWY_EXPORT(meanOf);

BlockEnergies::BlockEnergies(const fourier::Spectrum &spectrum, const task::Progress &progress)
    : m_padded(spectrum.layout().padded) {
    const fourier::CellLayout &layout = spectrum.cellLayout();
    m_table = {layout.step,
               layout.columns,
               (layout.rows + side - 1) / side,
               layout.planes / side,
               {float(layout.firstX), float(layout.firstY), float(layout.firstZ)},
               {float(m_padded.i), float(m_padded.j), float(m_padded.k)},
               {}};
    task::orOutOfMemory(task::because::noMemoryForTheKernelWidths, [&] {
        m_table.energies.resize(std::size_t(m_table.columns) * std::size_t(m_table.rows) *
                                std::size_t(m_table.planes));
    });
    tbb::parallel_for(0, m_table.columns * m_table.planes, [&](int part) {
        progress.check();
        HWY_DYNAMIC_DISPATCH(addUpBlocks)
        (spectrum, part / m_table.planes, part % m_table.planes, m_table);
    });
}

float BlockEnergies::mean(const std::array<double, 3> &first, const Points &points) const {
    const std::array<float, 3> from{float(first[0]), float(first[1]), float(first[2])};
    return HWY_DYNAMIC_DISPATCH(meanOf)(m_table, from.data(), points);
}

} // namespace pellucid::widths
#endif
