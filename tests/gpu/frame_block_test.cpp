// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>

#include <epoxy/gl.h>

#include "core/fourier/transforms/padded_size.h"
#include "gpu/frame_block.h"
#include "gpu/program.h"
#include "tests/gpu/card.h"

namespace pellucid {

namespace {

class FrameBlock : public test::CardTest {};

// The compiler's own layout of the block.
TEST_F(FrameBlock, LiesWhereTheShadersReadIt) {
    using gpu::FrameBlock;
    const std::map<std::string, std::size_t> members{
        {"originLow", offsetof(FrameBlock, originLow)},
        {"originHigh", offsetof(FrameBlock, originHigh)},
        {"columnLow", offsetof(FrameBlock, columnLow)},
        {"columnHigh", offsetof(FrameBlock, columnHigh)},
        {"rowLow", offsetof(FrameBlock, rowLow)},
        {"rowHigh", offsetof(FrameBlock, rowHigh)},
        {"termLow[0]", offsetof(FrameBlock, termLow)},
        {"termHigh[0]", offsetof(FrameBlock, termHigh)},
        {"termWeight[0]", offsetof(FrameBlock, termWeight)},
        {"columns", offsetof(FrameBlock, columns)},
        {"rows", offsetof(FrameBlock, rows)},
        {"pictureColumns", offsetof(FrameBlock, pictureColumns)},
        {"pictureRows", offsetof(FrameBlock, pictureRows)},
        {"periodRows", offsetof(FrameBlock, periodRows)},
        {"termCount", offsetof(FrameBlock, termCount)},
        {"fieldCount", offsetof(FrameBlock, fieldCount)},
        {"sourceCount", offsetof(FrameBlock, sourceCount)},
        {"reconstruction", offsetof(FrameBlock, reconstruction)},
        {"wraps", offsetof(FrameBlock, wraps)},
        {"tilesPerSide", offsetof(FrameBlock, tilesPerSide)},
        {"slabStep", offsetof(FrameBlock, slabStep)},
        {"columnStages", offsetof(FrameBlock, columnStages)},
        {"rowStages", offsetof(FrameBlock, rowStages)},
        {"columnRotations", offsetof(FrameBlock, columnRotations)},
        {"rowRotations", offsetof(FrameBlock, rowRotations)},
        {"unpackRotations", offsetof(FrameBlock, unpackRotations)},
        {"rollOff", offsetof(FrameBlock, rollOff)},
        {"detail", offsetof(FrameBlock, detail)},
        {"detailWidth", offsetof(FrameBlock, detailWidth)},
        {"unit", offsetof(FrameBlock, unit)},
        {"cueBase", offsetof(FrameBlock, cueBase)},
        {"padded", offsetof(FrameBlock, padded)},
        {"firstCell", offsetof(FrameBlock, firstCell)},
        {"inversePadded", offsetof(FrameBlock, inversePadded)},
        {"edgeSlack", offsetof(FrameBlock, edgeSlack)},
        {"perMoment", offsetof(FrameBlock, perMoment)},
        {"channelWeights[0]", offsetof(FrameBlock, channelWeights)},
        {"places[0].page", offsetof(FrameBlock, places) + offsetof(FrameBlock::Place, page)},
        {"places[1].firstPlane", offsetof(FrameBlock, places) + sizeof(FrameBlock::Place) +
                                     offsetof(FrameBlock::Place, firstPlane)},
        {"zero[0].value", offsetof(FrameBlock, zero) + offsetof(FrameBlock::ZeroSum, value)},
        {"zero[1].moment", offsetof(FrameBlock, zero) + sizeof(FrameBlock::ZeroSum) +
                               offsetof(FrameBlock::ZeroSum, moment)},
        {"shade[0].ambient",
         offsetof(FrameBlock, shade) + offsetof(FrameBlock::ImageShade, ambient)},
        {"shade[1].magnitude", offsetof(FrameBlock, shade) + sizeof(FrameBlock::ImageShade) +
                                   offsetof(FrameBlock::ImageShade, magnitude)},
        {"gradient[0]", offsetof(FrameBlock, gradient)},
        {"excess[0]", offsetof(FrameBlock, excess)},
        {"kernels[0]", offsetof(FrameBlock, kernels)},
        {"momentKernels[0]", offsetof(FrameBlock, momentKernels)},
        {"radices[0]", offsetof(FrameBlock, radices)}};
    const gpu::Defines defines{
        {"WIDTH", 4}, {"EVEN_TERMS", 4}, {"MOMENT_TERMS", 4}, {"FIELD_PAGES", 1}, {"PAGES", 2},
        {"SLABS", 1}, {"SUMS", 1},       {"IMAGES", 1},       {"SHADED", 1},      {"CUED", 1},
        {"LIT", 1},   {"TRILINEAR", 0},  {"FUSED", 1},        {"ROOM", 512}};
    card->device().run([&] {
        const unsigned program = card->device().program("columns.comp", defines).id();
        for (const auto &[name, offset] : members) {
            const std::string full = "Frame." + name;
            const char *const text = full.c_str();
            GLuint index = GL_INVALID_INDEX;
            glGetUniformIndices(program, 1, &text, &index);
            if (index == GL_INVALID_INDEX) { // not named after the block where it has an instance
                const char *const plain = name.c_str();
                glGetUniformIndices(program, 1, &plain, &index);
            }
            ASSERT_NE(index, GL_INVALID_INDEX) << name;
            GLint found = -1;
            glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &found);
            EXPECT_EQ(std::size_t(found), offset) << name;
        }
        GLint bytes = 0;
        glGetActiveUniformBlockiv(program, glGetUniformBlockIndex(program, "Frame"),
                                  GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        EXPECT_EQ(std::size_t(bytes), sizeof(FrameBlock));
    });
}

TEST(Bindings, AreThoseOfTheShaders) {
    std::ifstream file(PELLUCID_SHADERS "/lib/bindings.glsl");
    std::map<std::string, int> defined;
    for (std::string word; file >> word;)
        if (word == "#define") {
            std::string name;
            int value = -1;
            file >> name >> value;
            defined[name] = value;
        }
    namespace bindings = gpu::bindings;
    const std::map<std::string, int> expected{{"FRAME_BLOCK", bindings::frameBlock},
                                              {"DISC_ROWS", bindings::discRows},
                                              {"TILE_WIDTHS", bindings::tileWidths},
                                              {"ROTATIONS", bindings::rotations},
                                              {"SLICE", bindings::slice},
                                              {"LINES", bindings::lines},
                                              {"PICTURE", bindings::picture},
                                              {"FIRST_SPECTRUM", bindings::firstSpectrum},
                                              {"MAX_SPECTRA", bindings::maxSpectra},
                                              {"MAX_PAGES", bindings::maxPages},
                                              {"MAX_TERMS", bindings::maxTerms},
                                              {"MAX_PAIRS", bindings::maxPairs},
                                              {"MAX_PAIR_VECTORS", bindings::maxPairVectors},
                                              {"MAX_WIDTH", bindings::maxWidth},
                                              {"TILE_COLUMNS", bindings::tileColumns},
                                              {"TILE_ROWS", bindings::tileRows},
                                              {"THREADS", bindings::threads}};
    EXPECT_EQ(defined, expected);
}

TEST(Bindings, HoldWhatThePlanMayAskFor) {
    namespace bindings = gpu::bindings;
    EXPECT_GE(bindings::maxTerms, int(2 * shading::maxCurveValues));
    EXPECT_GE(2 * bindings::maxPairVectors, fourier::Kernel::largestTerms);
    EXPECT_EQ(bindings::maxWidth, fourier::Kernel::largestWidth);
    EXPECT_EQ(bindings::tileColumns, widths::SliceTiles::columns);
    EXPECT_EQ(bindings::tileRows, widths::SliceTiles::rows);
    EXPECT_GE(2 * bindings::maxPairs, fourier::Kernel::largestWidth);
    for (int n = 2; n <= 65536; n = fourier::smoothEvenSize(n + 1)) {
        int product = 1;
        const auto radices = gpu::radicesOf(n);
        for (const int radix : radices)
            product *= radix;
        EXPECT_EQ(product, n);
        EXPECT_LE(radices.size(), 16U) << n; // four vectors of stages
    }
}

} // namespace
} // namespace pellucid
