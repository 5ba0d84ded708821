// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/render/frame_inputs.h"
#include "gpu/bindings.h"

namespace pellucid::gpu {

/// The uniform block of a frame, in the std140 layout of shaders/lib/frame.glsl; a test compares
/// the two.
struct FrameBlock {
    template <class T> using Four = std::array<T, 4>;
    template <std::size_t n> using Vectors = std::array<Four<float>, n>;
    static constexpr std::size_t kernelVectors =
        std::size_t(3) * bindings::maxPairs * bindings::maxPairVectors;

    struct alignas(16) Place {
        std::int32_t page, firstPlane;
    };
    struct alignas(16) ZeroSum {
        float value, moment;
    };
    struct alignas(16) ImageShade {
        float ambient, magnitude;
    };

    Four<std::uint32_t> originLow, originHigh, columnLow, columnHigh, rowLow, rowHigh;
    std::array<Four<std::uint32_t>, bindings::maxTerms> termLow, termHigh;
    Vectors<bindings::maxTerms> termWeight;
    std::int32_t columns, rows, pictureColumns, pictureRows, periodRows;
    std::int32_t termCount, fieldCount, sourceCount;
    std::int32_t reconstruction, wraps, tilesPerSide, slabStep;
    std::int32_t columnStages, rowStages;
    std::int32_t columnRotations, rowRotations, unpackRotations;
    float rollOff, unit, cueBase;
    float detail, detailWidth;             ///< see render::RadialFactors
    alignas(16) Four<std::int32_t> padded; // std140 aligns vectors to their size
    Four<std::int32_t> firstCell;
    Four<float> inversePadded, edgeSlack, perMoment;
    Vectors<bindings::maxSpectra> channelWeights;
    std::array<Place, bindings::maxSpectra> places;
    std::array<ZeroSum, 6> zero;
    std::array<ImageShade, 3> shade;
    Vectors<3> gradient, excess;
    Vectors<bindings::maxWidth * kernelVectors> kernels;
    Vectors<bindings::maxWidth * kernelVectors> momentKernels;
    std::array<Four<std::int32_t>, 8> radices;
};

/// The radices of an inverse transform's stages, out of 8, 7, 5, 4, 3 and 2; their product is the
/// length. *Requires*: the length is 1 or smooth, see fourier::smoothEvenSize.
std::vector<int> radicesOf(int length);

/// Tables that depend on the slice grid only.
struct GridTables {
    explicit GridTables(const plan::SliceGrid &grid);

    /// The last row of each column inside the disc of the band.
    std::vector<std::int32_t> discRows;
    /// exp(+i 2 pi n / length) for three lengths: a column (`rows` values), a row packed into
    /// `columns` / 2 complex numbers (`columns` / 2 values), and a whole row (the first `columns` /
    /// 2 values, for unpacking).
    std::vector<std::array<float, 2>> rotations;
    std::int32_t columnRotations = 0, rowRotations = 0, unpackRotations = 0; ///< their offsets
};

/// Sets the members that the transforms read.
void setTransforms(FrameBlock &block, const plan::SliceGrid &grid, int imageColumns, int imageRows,
                   const GridTables &tables);

/// How spectra are stored in textures ("pages"): several spectra stacked in one page, or one
/// spectrum split into slabs of planes, one page each, that overlap by the kernel's width - 1.
struct TexelLayout {
    int columns = 0, rows = 0;
    int planes = 0;                 ///< per spectrum, or per slab of one
    std::array<int, 3> firstCell{}; ///< grid index of a spectrum's first texel
    int perPage = 1;                ///< spectra per page
    int slabs = 1;
    int slabStep = 0; ///< planes from one slab's beginning to the next

    /// First page and first plane of spectrum n.
    std::array<int, 2> placeOf(std::size_t n) const {
        return {int(n) / perPage * slabs, int(n) % perPage * planes};
    }
    /// The number of pages that `count` spectra take.
    int pagesOf(std::size_t count) const { return (int(count) + perPage - 1) / perPage * slabs; }
};

/// The parameters of a frame's slice for the shaders. `fieldPages`: number of pages of the fields,
/// which come before those of the gradients. *Requires*: `inputs` is not empty. *Throws*
/// Error{outOfMemory} if the slice extends beyond 2^22 cells.
FrameBlock frameBlock(const render::FrameInputs &inputs, const scene::ImageDefinition &image,
                      const fourier::SpectrumLayout &layout, const TexelLayout &texels,
                      int fieldPages);

} // namespace pellucid::gpu
