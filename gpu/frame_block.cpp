// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/frame_block.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/task/error.h"
#include "gpu/reasons.h"

namespace pellucid::gpu {

namespace {

// Fixed point in two's complement: cells in 24.40 bits, turns in 0.64 bits.
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

// A vector holds two even and two odd coefficients: even, odd, even, odd.
template <class Kernel>
void packPairs(const Kernel &kernel, int axis, FrameBlock::Four<float> *vectors) {
    const auto terms = std::size_t(kernel.terms());
    const std::vector<float> &pairs = kernel.pairs();
    for (std::size_t pair = 0; pair < pairs.size() / (2 * terms); ++pair)
        for (std::size_t n = 0; n < terms; ++n) {
            auto &vector =
                vectors[(std::size_t(axis) * bindings::maxPairs + pair) * bindings::maxPairVectors +
                        n / 2];
            vector[n % 2 * 2] = pairs[pair * 2 * terms + n];
            vector[n % 2 * 2 + 1] = pairs[pair * 2 * terms + terms + n];
        }
}

FrameBlock::Four<float> three(const std::array<double, 3> &values) {
    return {float(values[0]), float(values[1]), float(values[2]), 0.0F};
}

// The position of the slice in the spectrum.
void setSlice(FrameBlock &block, const render::FrameInputs &inputs) {
    const render::FrameGeometry &geometry = inputs.geometry;
    const plan::SliceGrid &grid = inputs.grid;
    // Coordinates have 23 bits of whole cells and would wrap around beyond that.
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
    block.wraps = geometry.wraps ? 1 : 0;
    block.unit = float(inputs.unit());
    for (std::size_t d = 0; d < 3; ++d)
        block.edgeSlack[d] = geometry.edgeSlack[d];
}

// The effect of cue and lights on the sums.
void setShading(FrameBlock &block, const render::FrameInputs &inputs) {
    const render::FrameShading &shading = inputs.shading;
    for (std::size_t kind = 0; kind < 2; ++kind)
        for (std::size_t c = 0; c < 3; ++c)
            block.zero[3 * kind + c] = {float(inputs.zero[kind][c].value),
                                        float(inputs.zero[kind][c].moment)};
    block.termCount = shading.termCount;
    for (std::size_t t = 0; t < std::size_t(shading.termCount); ++t) {
        split(stepsOf(shading.terms[t].cells, 0.0), block.termLow[t], block.termHigh[t]);
        block.termWeight[t] = {shading.terms[t].weight.real(), shading.terms[t].weight.imag()};
    }
    block.cueBase = shading.base;
    block.perMoment = three(shading.perMoment);
    for (std::size_t c = 0; c < 3; ++c) {
        block.shade[c] = {shading.images[c].ambient, shading.images[c].magnitude};
        block.gradient[c] = three(shading.images[c].gradient);
        block.excess[c] = three(shading.images[c].excess);
    }
    for (std::size_t width = 1; shading.kernels != nullptr && width < shading.kernels->size();
         ++width)
        for (std::size_t d = 0; d < (*shading.kernels)[width].size(); ++d)
            packPairs((*shading.kernels)[width][d], int(d),
                      block.momentKernels.data() + (width - 1) * FrameBlock::kernelVectors);
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
    rowRotations = std::int32_t(rotations.size());
    add(grid.columns / 2, grid.columns / 2);
    unpackRotations = std::int32_t(rotations.size());
    add(grid.columns, grid.columns / 2);
    // The Nyquist row and column are on the edge of the disc, where the roll-off is 0. Row 0 of
    // every column is inside.
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
    block.columns = grid.columns;
    block.rows = grid.rows;
    block.pictureColumns = imageColumns;
    block.pictureRows = imageRows;
    block.periodRows = std::min(imageRows, grid.rows);
    const std::array<std::vector<int>, 2> radices{radicesOf(grid.rows),
                                                  radicesOf(grid.columns / 2)};
    block.columnStages = std::int32_t(radices[0].size());
    block.rowStages = std::int32_t(radices[1].size());
    for (std::size_t plan = 0; plan < 2; ++plan)
        for (std::size_t s = 0; s < radices[plan].size(); ++s)
            block.radices[4 * plan + s / 4][s % 4] = radices[plan][s];
    block.columnRotations = tables.columnRotations;
    block.rowRotations = tables.rowRotations;
    block.unpackRotations = tables.unpackRotations;
}

FrameBlock frameBlock(const render::FrameInputs &inputs, const scene::ImageDefinition &image,
                      const fourier::SpectrumLayout &layout, const TexelLayout &texels,
                      int fieldPages) {
    const render::Mixing &mixing = inputs.mixing;
    FrameBlock block{};
    setSlice(block, inputs);
    block.reconstruction = int(image.reconstruction);
    block.rollOff = float(image.rollOff);
    block.detail = float(inputs.radial.detail);
    block.detailWidth = float(inputs.radial.detailWidth);
    block.tilesPerSide = inputs.widthMap ? inputs.widthMap->tiles : 0;
    block.slabStep = texels.slabStep;
    block.padded = {layout.padded.i, layout.padded.j, layout.padded.k};
    for (int d = 0; d < 3; ++d) {
        const auto axis = std::size_t(d);
        block.firstCell[axis] = texels.firstCell[axis];
        block.inversePadded[axis] = 1.0F / float(layout.padded[d]);
        const auto pack = [&](int width, const fourier::Kernel &kernel) {
            packPairs(kernel, d,
                      block.kernels.data() + std::size_t(width - 1) * FrameBlock::kernelVectors);
        };
        pack(layout.width(), layout.kernels[axis]);
        for (int width = fourier::KernelsByWidth::narrowest;
             inputs.kernels && width < layout.width(); ++width)
            pack(width, inputs.kernels->of(width)[axis]);
    }
    block.sourceCount = std::int32_t(mixing.sources.size());
    for (std::size_t s = 0; s < mixing.sources.size(); ++s) {
        const render::FrameSource &source = mixing.sources[s];
        block.channelWeights[s] = {source.channelWeights[0], source.channelWeights[1],
                                   source.channelWeights[2]};
        // Fields and their pages come before those of the gradients.
        const bool isField = source.kind == render::FrameKind::field;
        block.fieldCount += isField ? 1 : 0;
        const auto [page, plane] = texels.placeOf(source.field);
        block.places[s] = {page + (isField ? 0 : fieldPages), plane};
    }
    setShading(block, inputs);
    return block;
}

} // namespace pellucid::gpu
