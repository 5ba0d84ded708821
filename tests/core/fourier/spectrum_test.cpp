// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "core/fourier/spectrum.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using fourier::Spectrum;

TEST(Spectrum, CellsAreThePremultipliedSumAndTheApronWraps) {
    const auto lattice = test::tiltedLattice({9, 6, 5}, {0.7, 0.9, 2.0}, 12);
    const auto field = test::noiseField(lattice);
    const fourier::SpectrumLayout layout{
        fourier::Kernel::exponentialSemicircle(5, 1.5), field.support, {16, 18, 20}};
    const Spectrum spectrum = Spectrum::prepare(field.values, layout);

    const auto exact = [&](int p, int q, int r) {
        std::complex<double> sum = 0.0;
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 9; ++i) {
                    const int x = i - 4, y = j - 3, z = k - 2;
                    const double h = layout.kernel.apodisation(x, 16) *
                                     layout.kernel.apodisation(y, 18) *
                                     layout.kernel.apodisation(z, 20);
                    const double turns = p * x / 16.0 + q * y / 18.0 + r * z / 20.0;
                    sum += field.values.value({i, j, k}) / h *
                           std::polar(1.0, -2.0 * std::numbers::pi * turns);
                }
        return sum * lattice.cellVolumeMm3();
    };
    // Inside, on the planes where the half ends, and everywhere in the apron.
    const double scale = std::abs(exact(0, 0, 0));
    for (const auto &[p, q, r] : {std::array{0, 0, 0},
                                  {3, 2, 1},
                                  {8, 17, 19},
                                  {8, 9, 10},
                                  {-1, 0, 0},
                                  {-4, -4, -4},
                                  {12, 21, 23},
                                  {9, 3, -2},
                                  {5, 18, 7},
                                  {2, -3, 20}}) {
        const std::complex<double> found(
            spectrum.origin()[r * spectrum.planeStride() + q * spectrum.rowStride() + p]);
        EXPECT_LT(std::abs(found - exact(p, q, r)), 1e-6 * scale) << p << " " << q << " " << r;
    }
}

TEST(Spectrum, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    const auto field = test::noiseField(volume::Lattice::centred({8, 8, 8}, {1, 1, 1}));
    const fourier::SpectrumLayout layout{
        fourier::Kernel::exponentialSemicircle(5, 1.5), field.support, {16, 16, 16}};
    EXPECT_THROW(Spectrum::prepare(field.values, layout, task::Progress(source.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
