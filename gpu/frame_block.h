// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/render/frame_geometry.h"
#include "core/render/frame_mixing.h"
#include "gpu/bindings.h"

namespace pellucid::gpu {

/// The uniform block of a frame as shaders/lib/frame.glsl lays it out (std140), which a test
/// compares.
struct FrameBlock {
    template <class T> using Four = std::array<T, 4>;
    template <std::size_t n> using Vectors = std::array<Four<float>, n>;
    static constexpr std::size_t kernelVectors =
        std::size_t(3) * bindings::mostPairs * bindings::mostPairVectors;

    Four<std::uint32_t> originLow, originHigh, columnLow, columnHigh, rowLow, rowHigh;
    std::array<Four<std::uint32_t>, bindings::mostTerms> termLow, termHigh;
    Vectors<bindings::mostTerms> termWeight;
    Four<std::int32_t> grid, counts, image, padded, firstCell;
    Four<float> inversePadded, edgeSlack, scales, perMoment;
    Vectors<bindings::mostSpectra> shares;
    std::array<Four<std::int32_t>, bindings::mostSpectra> places;
    Vectors<6> zero;
    Vectors<3> shade, gradient, excess;
    Vectors<kernelVectors> kernels, momentKernels;
    Four<std::int32_t> stages;
    std::array<Four<std::int32_t>, 8> radices;
    Four<std::int32_t> tables;
};

/// The stages of an inverse transform: radices 8, 7, 5, 4, 3 and 2 whose product is the length.
/// *Shape*: the length is smooth, see fourier::smoothEvenSize, or 1.
std::vector<int> radicesOf(int length);

/// What depends on the slice grid alone.
struct GridTables {
    explicit GridTables(const plan::SliceGrid &grid);

    /// The last row of each column within the band's disc.
    std::vector<std::int32_t> discRows;
    /// exp(+i 2 pi n / length) for rows, half the columns and, half of it, all columns.
    std::vector<std::array<float, 2>> rotations;
    FrameBlock::Four<std::int32_t> tables{}; ///< where each begins
};

/// Sets what the transforms need to know.
void setTransforms(FrameBlock &block, const plan::SliceGrid &grid, int imageColumns, int imageRows,
                   const GridTables &tables);

/// How spectra lie in textures: several on top of each other in a page, or one in slabs of planes
/// that overlap by a kernel's width, a page each.
struct TexelLayout {
    int columns = 0, rows = 0;
    int planes = 0;                 ///< of a spectrum, or of a slab of one
    std::array<int, 3> firstCell{}; ///< the index of a spectrum's first texel
    int perPage = 1;                ///< spectra
    int slabs = 1;
    int slabStep = 0; ///< planes between the beginnings of slabs

    /// Page and plane of the nth spectrum.
    std::array<int, 2> placeOf(std::size_t n) const {
        return {int(n) / perPage * slabs, int(n) % perPage * planes};
    }
    int pagesOf(std::size_t count) const { return (int(count) + perPage - 1) / perPage * slabs; }
};

/// The slice of a frame as the shaders see it. *Throws* Error{outOfMemory} if it reaches further
/// than 2^22 cells. `fieldPages`: those before the gradients' pages.
FrameBlock frameBlock(const plan::SliceGrid &grid, const scene::ImageDefinition &image,
                      const render::FrameGeometry &geometry, const render::Mixing &mixing,
                      const render::FrameShading *shading, const fourier::SpectrumLayout &layout,
                      const TexelLayout &texels, int fieldPages);

} // namespace pellucid::gpu
