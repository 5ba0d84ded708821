// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/frame_block.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/task/error.h"

namespace pellucid::gpu {

namespace {

// Two's complement of a number of cells, 24.40 bits, or of turns, 0.64 bits.
std::uint64_t fixedCells(double cells) {
    return std::uint64_t(std::int64_t(std::llround(std::ldexp(cells, 40))));
}
std::uint64_t fixedTurns(double turns) {
    const double part = turns - std::floor(turns);
    return std::uint64_t(std::int64_t(std::llround(std::ldexp(part - 0.5, 63)))) * 2U +
           (std::uint64_t(1) << 63);
}

using Steps = std::array<std::uint64_t, 4>;

Steps stepsOf(const std::array<double, 3> &cells, double turns) {
    return {fixedCells(cells[0]), fixedCells(cells[1]), fixedCells(cells[2]), fixedTurns(turns)};
}

void split(const Steps &steps, FrameBlock::Four<std::uint32_t> &low,
           FrameBlock::Four<std::uint32_t> &high) {
    for (std::size_t n = 0; n < steps.size(); ++n) {
        low[n] = std::uint32_t(steps[n]);
        high[n] = std::uint32_t(steps[n] >> 32);
    }
}

// Two of a pair's coefficients, even and odd, a vector.
template <class Kernel>
void packPairs(const Kernel &kernel, int axis,
               FrameBlock::Vectors<FrameBlock::kernelVectors> &vectors) {
    const auto terms = std::size_t(kernel.terms());
    const std::vector<float> &pairs = kernel.pairs();
    for (std::size_t pair = 0; pair < pairs.size() / (2 * terms); ++pair)
        for (std::size_t n = 0; n < terms; ++n) {
            auto &vector = vectors[(std::size_t(axis) * bindings::mostPairs + pair) *
                                       bindings::mostPairVectors +
                                   n / 2];
            vector[n % 2 * 2] = pairs[pair * 2 * terms + n];
            vector[n % 2 * 2 + 1] = pairs[pair * 2 * terms + terms + n];
        }
}

FrameBlock::Four<float> three(const std::array<double, 3> &values) {
    return {float(values[0]), float(values[1]), float(values[2]), 0.0F};
}

} // namespace

std::vector<int> radicesOf(int length) {
    std::vector<int> radices;
    for (const int radix : {8, 7, 5, 4, 3, 2})
        for (; length % radix == 0; length /= radix)
            radices.push_back(radix);
    return radices;
}

GridTables::GridTables(const plan::SliceGrid &grid) {
    const auto add = [&](int length, int count) {
        for (int n = 0; n < count; ++n) {
            const double angle = 2.0 * std::numbers::pi * n / length;
            rotations.push_back({float(std::cos(angle)), float(std::sin(angle))});
        }
    };
    add(grid.rows, grid.rows);
    tables[1] = std::int32_t(rotations.size());
    add(grid.columns / 2, grid.columns / 2);
    tables[2] = std::int32_t(rotations.size());
    add(grid.columns, grid.columns / 2);
    // The Nyquist row and column lie on the edge of the disc, whose roll-off is 0. Row 0 of every
    // column lies within.
    int row = grid.rows / 2 - 1;
    for (int column = 0; column < grid.columns / 2; ++column) {
        const double u = 2.0 * column / grid.columns;
        while (row > 0 && !(std::hypot(u, 2.0 * row / grid.rows) < 1.0))
            --row;
        discRows.push_back(row);
    }
}

void setTransforms(FrameBlock &block, const plan::SliceGrid &grid, int imageColumns, int imageRows,
                   const GridTables &tables) {
    block.grid = {grid.columns, grid.rows, imageColumns, imageRows};
    block.counts[2] = std::min(imageRows, grid.rows);
    const std::array<std::vector<int>, 2> radices{radicesOf(grid.rows),
                                                  radicesOf(grid.columns / 2)};
    for (std::size_t plan = 0; plan < 2; ++plan) {
        block.stages[plan] = std::int32_t(radices[plan].size());
        for (std::size_t s = 0; s < radices[plan].size(); ++s)
            block.radices[4 * plan + s / 4][s % 4] = radices[plan][s];
    }
    block.tables = tables.tables;
}

FrameBlock frameBlock(const plan::SliceGrid &grid, const scene::ImageDefinition &image,
                      const render::FrameGeometry &geometry, const render::Mixing &mixing,
                      const render::FrameShading *shading, const fourier::SpectrumLayout &layout,
                      const TexelLayout &texels, int fieldPages) {
    FrameBlock block{};
    // 23 bits of whole cells, beyond which a coordinate would come round again.
    for (std::size_t d = 0; d < 3; ++d)
        if (std::abs(geometry.cellsPerColumn[d]) * grid.columns +
                std::abs(geometry.cellsPerRow[d]) * grid.rows >
            0x1p22)
            throw task::Error(task::ErrorCode::outOfMemory, task::because::imageExceedsCard);
    const Steps column = stepsOf(geometry.cellsPerColumn, geometry.turnsPerColumn);
    const Steps row = stepsOf(geometry.cellsPerRow, geometry.turnsPerRow);
    Steps origin{};
    for (std::size_t n = 0; n < origin.size(); ++n)
        origin[n] = row[n] * (0U - std::uint64_t(grid.rows / 2));
    split(column, block.columnLow, block.columnHigh);
    split(row, block.rowLow, block.rowHigh);
    split(origin, block.originLow, block.originHigh);

    block.image = {int(image.reconstruction), geometry.wraps ? 1 : 0, 0, 0};
    block.padded = {layout.padded.i, layout.padded.j, layout.padded.k, texels.slabStep};
    // A single grey image has its share at once.
    block.scales = {float(image.rollOff),
                    float(geometry.cellArea * mixing.unit * (mixing.grey ? mixing.color[0] : 1.0)),
                    1.0F, 0.0F};
    for (int d = 0; d < 3; ++d) {
        const auto axis = std::size_t(d);
        block.firstCell[axis] = texels.firstCell[axis];
        block.edgeSlack[axis] = geometry.edgeSlack[axis];
        block.inversePadded[axis] = 1.0F / float(layout.padded[d]);
        packPairs(layout.kernels[axis], d, block.kernels);
    }
    block.counts[3] = std::int32_t(mixing.sources.size());
    for (std::size_t s = 0; s < mixing.sources.size(); ++s) {
        const render::FrameSource &source = mixing.sources[s];
        block.shares[s] = {source.shares[0], source.shares[1], source.shares[2]};
        // Fields come first, and so do their pages.
        const bool isField = source.kind == render::FrameKind::field;
        block.counts[1] += isField ? 1 : 0;
        const auto [page, plane] = texels.placeOf(source.field);
        block.places[s] = {page + (isField ? 0 : fieldPages), plane};
    }
    render::FrameShading plain;
    const render::FrameShading &shades = shading != nullptr ? *shading : plain;
    const render::ZeroSums zero = render::zeroSums(mixing, shades, layout);
    for (std::size_t kind = 0; kind < 2; ++kind)
        for (std::size_t c = 0; c < 3; ++c)
            block.zero[3 * kind + c] = {float(zero[kind][c].value), float(zero[kind][c].moment)};
    block.counts[0] = shades.termCount;
    for (std::size_t t = 0; t < std::size_t(shades.termCount); ++t) {
        split(stepsOf(shades.terms[t].cells, 0.0), block.termLow[t], block.termHigh[t]);
        block.termWeight[t] = {shades.terms[t].weight.real(), shades.terms[t].weight.imag()};
    }
    block.scales[2] = shades.base;
    block.perMoment = three(shades.perMoment);
    for (std::size_t c = 0; c < 3; ++c) {
        block.shade[c] = {shades.images[c].ambient, shades.images[c].magnitude};
        block.gradient[c] = three(shades.images[c].gradient);
        block.excess[c] = three(shades.images[c].excess);
    }
    if (shades.kernels != nullptr)
        for (int d = 0; d < 3; ++d)
            packPairs((*shades.kernels)[std::size_t(d)], d, block.momentKernels);
    return block;
}

} // namespace pellucid::gpu
