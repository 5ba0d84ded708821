// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <complex>
#include <random>

#include <epoxy/gl.h>

#include "core/fourier/transforms/padded_size.h"
#include "core/fourier/transforms/transform.h"
#include "gpu/transform_passes.h"
#include "tests/gpu/card.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

class TransformPasses : public test::CardTest {
protected:
    // White noise in the half spectrum of every image, by the passes and by FFTW.
    static double error(const plan::SliceGrid &grid, int images, int imageColumns, int imageRows) {
        const int halfColumns = grid.columns / 2;
        std::mt19937 random(11);
        std::normal_distribution<float> normal;
        std::vector<std::complex<float>> slice(std::size_t(images) * std::size_t(halfColumns) *
                                               std::size_t(grid.rows));
        for (auto &value : slice)
            value = {normal(random), normal(random)};
        const auto at = [&](int image, int column, int row) -> std::complex<float> & {
            return slice[(std::size_t(image) * std::size_t(halfColumns) + std::size_t(column)) *
                             std::size_t(grid.rows) +
                         std::size_t(row)];
        };
        // The image is real, so column 0 is the conjugate of its mirror.
        for (int image = 0; image < images; ++image)
            for (int row = 0; row <= grid.rows / 2; ++row) {
                auto &value = at(image, 0, row),
                     &mirror = at(image, 0, (grid.rows - row) % grid.rows);
                if (&value == &mirror)
                    value = value.real();
                else
                    mirror = std::conj(value);
            }
        picture::Samples found;
        card->device().run([&] {
            gpu::TransformPasses passes(card->device());
            passes.fit(grid, images);
            const gpu::GridTables tables(grid);
            gpu::FrameBlock frame{};
            gpu::setTransforms(frame, grid, imageColumns, imageRows, tables);
            gpu::Buffer block, rotations, values;
            block.upload(&frame, sizeof(frame));
            block.bindUniform(gpu::bindings::frameBlock);
            rotations.upload(tables.rotations.data(), tables.rotations.size() * 8);
            rotations.bindStorage(gpu::bindings::rotations);
            gpu::PixelTexture picture;
            picture.reserve(imageColumns, imageRows, images);
            const_cast<gpu::Buffer &>(passes.slice()).upload(slice.data(), slice.size() * 8);
            passes.transformRows(frame, images, passes.transformColumns(frame, images), picture);
            found = picture.download();
        });
        std::vector<double> expected;
        const fourier::InverseTransform2d<double> exact(grid.rows, grid.columns);
        for (int image = 0; image < images; ++image) {
            std::vector<std::complex<double>> half(std::size_t(grid.rows) *
                                                   std::size_t(halfColumns + 1));
            for (int row = 0; row < grid.rows; ++row)
                for (int column = 0; column < halfColumns; ++column)
                    half[std::size_t(row) * std::size_t(halfColumns + 1) + std::size_t(column)] =
                        at(image, column, row);
            std::vector<double> pixels(std::size_t(grid.rows) * std::size_t(grid.columns));
            exact.run(half.data(), pixels.data());
            for (int y = 0; y < imageRows; ++y)
                for (int x = 0; x < imageColumns; ++x)
                    expected.push_back(
                        pixels[std::size_t(y % grid.rows) * std::size_t(grid.columns) +
                               std::size_t(x % grid.columns)]);
        }
        return test::relativeL2(found, expected);
    }
};

// Rounding grows with the logarithm of the length: 6e-8 a stage.
constexpr double rounding = 6e-7;

TEST_F(TransformPasses, EverySizeAlongBothDirections) {
    // Every smooth even length up to 2048 as columns and, in another order, as rows.
    std::vector<int> sizes;
    for (int n = 2; n <= 2048; n = fourier::smoothEvenSize(n + 1))
        sizes.push_back(n);
    for (std::size_t n = 0; n < sizes.size(); ++n) {
        const int columns = sizes[n], rows = std::min(sizes[sizes.size() - 1 - n], 256);
        EXPECT_LT(error({columns, rows}, 1, columns, rows), rounding) << columns << " x " << rows;
        EXPECT_LT(error({rows, columns}, 1, rows, columns), rounding) << rows << " x " << columns;
    }
}

// Rows may be longer than columns, because the transform of a row has half its length.
TEST_F(TransformPasses, RowsUpToTheSharedMemory) {
    for (int n = fourier::smoothEvenSize(2050); n <= 4096; n = fourier::smoothEvenSize(n + 1))
        EXPECT_LT(error({n, 6}, 1, n, 6), rounding) << n;
}

TEST_F(TransformPasses, LinesBeyondTheSharedMemory) {
    for (const auto &[columns, rows] : {std::pair(8192, 6),
                                        {16384, 10},
                                        {26250, 4},
                                        {65536, 2},
                                        {10, 5000},
                                        {4, 65536},
                                        {4374, 2100}})
        EXPECT_LT(error({columns, rows}, 1, std::min(columns, 16384), std::min(rows, 600)),
                  rounding)
            << columns << " x " << rows;
}

TEST_F(TransformPasses, SeveralImagesCroppedAndRepeated) {
    EXPECT_LT(error({96, 60}, 3, 50, 41), rounding);
    EXPECT_LT(error({96, 60}, 3, 250, 130), rounding);
    EXPECT_LT(error({4200, 2100}, 3, 31, 17), rounding);
}

} // namespace
} // namespace pellucid
