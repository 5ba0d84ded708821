// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fourier/transforms/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace pellucid {
namespace {

// The half spectrum of one wave, and the wave.
template <class Real> void expectWave(int rows, int columns, fourier::Planning planning) {
    const fourier::InverseTransform2d<Real> transform(rows, columns, planning);
    const int stride = columns / 2 + 1, row = rows / 3, column = columns / 5;
    std::vector<std::complex<Real>> half(std::size_t(rows) * stride);
    half[std::size_t(row) * stride + column] = {Real(0.5), Real(-1)};
    std::vector<Real> image(std::size_t(rows) * columns);
    transform.run(half.data(), image.data());
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double turn =
                2.0 * std::numbers::pi * (double(row) * r / rows + double(column) * c / columns);
            EXPECT_NEAR(double(image[std::size_t(r) * columns + c]),
                        2.0 * (0.5 * std::cos(turn) + std::sin(turn)), 1e-5)
                << r << ' ' << c;
        }
}

TEST(InverseTransform2d, MakesTheWaveOfACell) {
    expectWave<double>(24, 30, fourier::Planning::estimate);
    expectWave<float>(24, 30, fourier::Planning::estimate);
    expectWave<float>(31, 20, fourier::Planning::measure);
}

} // namespace
} // namespace pellucid
