// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/render/frame_inputs.h"
#include "gpu/bindings.h"

namespace pellucid::gpu {

/// The uniform block of a frame as shaders/lib/frame.glsl lays it out (std140), which a test
/// compares.
struct FrameBlock {
    template <class T> using Four = std::array<T, 4>;
    template <std::size_t n> using Vectors = std::array<Four<float>, n>;
    static constexpr std::size_t kernelVectors =
        std::size_t(3) * bindings::mostPairs * bindings::mostPairVectors;

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
    std::array<Four<std::uint32_t>, bindings::mostTerms> termLow, termHigh;
    Vectors<bindings::mostTerms> termWeight;
    std::int32_t columns, rows, pictureColumns, pictureRows, periodRows;
    std::int32_t termCount, fieldCount, sourceCount;
    std::int32_t reconstruction, wraps, slabStep;
    std::int32_t columnStages, rowStages;
    std::int32_t columnRotations, rowRotations, unpackRotations;
    float rollOff, unit, cueBase;
    alignas(16) Four<std::int32_t> padded; // vectors begin at multiples of their size
    Four<std::int32_t> firstCell;
    Four<float> inversePadded, edgeSlack, perMoment;
    Vectors<bindings::mostSpectra> shares;
    std::array<Place, bindings::mostSpectra> places;
    std::array<ZeroSum, 6> zero;
    std::array<ImageShade, 3> shade;
    Vectors<3> gradient, excess;
    Vectors<kernelVectors> kernels, momentKernels;
    std::array<Four<std::int32_t>, 8> radices;
};

/// The stages of an inverse transform: radices 8, 7, 5, 4, 3 and 2 whose product is the length.
/// *Shape*: the length is smooth, see fourier::smoothEvenSize, or 1.
std::vector<int> radicesOf(int length);

/// What depends on the slice grid alone.
struct GridTables {
    explicit GridTables(const plan::SliceGrid &grid);

    /// The last row of each column within the band's disc.
    std::vector<std::int32_t> discRows;
    /// exp(+i 2 pi n / length) of three lengths: of a column, which has a number for each row; of a
    /// row packed into half as many numbers; and half of those of a whole row, to unpack it.
    std::vector<std::array<float, 2>> rotations;
    std::int32_t columnRotations = 0, rowRotations = 0, unpackRotations = 0; ///< where each begins
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
/// than 2^22 cells. *Shape*: something is shown; `fieldPages`: those before the gradients' pages.
FrameBlock frameBlock(const render::FrameInputs &inputs, const scene::ImageDefinition &image,
                      const fourier::SpectrumLayout &layout, const TexelLayout &texels,
                      int fieldPages);

} // namespace pellucid::gpu
