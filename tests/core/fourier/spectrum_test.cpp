// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/fourier/kernels_by_width.h"
#include "core/fourier/spectrum.h"
#include "core/fourier/spectrum_passes.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using fourier::Spectrum;

class SpectrumCells : public testing::TestWithParam<fourier::Storage> {};

TEST_P(SpectrumCells, AreThePremultipliedSumAndTheApronWraps) {
    const auto lattice = test::tiltedLattice({9, 6, 5}, {0.7, 0.9, 2.0}, 12);
    const auto field = test::noiseField(lattice);
    const auto kernel = fourier::Kernel::exponentialSemicircle(5, 1.5);
    const fourier::SpectrumLayout layout{
        {kernel, kernel, kernel}, field.support, {16, 18, 20}, GetParam()};
    const Spectrum spectrum = Spectrum::prepare(field.values, layout);

    const auto exact = [&](int p, int q, int r) {
        std::complex<double> sum = 0.0;
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 6; ++j)
                for (int i = 0; i < 9; ++i) {
                    const int x = i - 4, y = j - 3, z = k - 2;
                    const double h = kernel.apodisation(x / 16.0) * kernel.apodisation(y / 18.0) *
                                     kernel.apodisation(z / 20.0);
                    const double turns = p * x / 16.0 + q * y / 18.0 + r * z / 20.0;
                    sum += field.values.value({i, j, k}) / h *
                           std::polar(1.0, -2.0 * std::numbers::pi * turns);
                }
        return sum * lattice.cellVolumeMm3();
    };
    // Inside, on the planes where the half ends, and everywhere in the halo. A binary16 cell is
    // rounded by 2^-12 of itself at most, a little more in a complex number.
    const double scale = std::abs(exact(0, 0, 0));
    const double rounding = GetParam() == fourier::Storage::binary16 ? 3.5e-4 : 0.0;
    for (const auto &[p, q, r] : {std::array{0, 0, 0},
                                  {3, 2, 1},
                                  {8, -1, -1},
                                  {8, 9, 10},
                                  {-1, 0, 0},
                                  {-3, -4, -4},
                                  {11, 3, 3},
                                  {9, 3, -2},
                                  {5, -9, 7},
                                  {2, -12, 13},
                                  {4, 12, -13}}) {
        const std::complex<double> expected = exact(p, q, r);
        EXPECT_LT(std::abs(spectrum.value(p, q, r) - expected),
                  1e-6 * scale + rounding * std::abs(expected))
            << p << " " << q << " " << r;
    }
}

INSTANTIATE_TEST_SUITE_P(Storages, SpectrumCells,
                         testing::Values(fourier::Storage::binary16, fourier::Storage::float32),
                         [](const auto &test) {
                             return test.param == fourier::Storage::binary16 ? "binary16"
                                                                             : "float32";
                         });

// The transform of a field at any grid coordinate.
std::complex<double> transformAt(const classify::DensityField &field,
                                 const fourier::SpectrumLayout &layout,
                                 const std::array<double, 3> &cells) {
    const volume::Lattice &lattice = field.values.lattice();
    const volume::GridSize n = lattice.size();
    std::complex<double> sum = 0.0;
    for (int k = 0; k < n.k; ++k)
        for (int j = 0; j < n.j; ++j)
            for (int i = 0; i < n.i; ++i) {
                const double turns = cells[0] * (i - n.i / 2) / layout.padded.i +
                                     cells[1] * (j - n.j / 2) / layout.padded.j +
                                     cells[2] * (k - n.k / 2) / layout.padded.k;
                sum += double(field.values.value({i, j, k})) *
                       std::polar(1.0, -2.0 * std::numbers::pi * turns);
            }
    return sum * lattice.cellVolumeMm3();
}

// Cells are read by the layout's own kernels and by narrower ones, in both halves and in other
// periods. A narrower kernel has a larger error, but never more than half of the value.
TEST(Spectrum, IsReadBetweenItsCellsByKernelsOfEveryWidth) {
    const auto lattice = test::tiltedLattice({22, 20, 18}, {0.7, 0.9, 2.0}, 12);
    const auto field = test::noiseField(lattice);
    for (const int width : {4, 6, 7}) {
        const auto kernel = fourier::Kernel::leastAliasing(width, 1.5);
        // 54 cells along x: with width 7 the last column is nearly empty.
        const fourier::SpectrumLayout layout{
            {kernel, kernel, kernel}, field.support, {54, 30, 28}, fourier::Storage::float32};
        const Spectrum spectrum = Spectrum::prepare(field.values, layout);
        const fourier::KernelsByWidth kernels(layout);
        ASSERT_EQ(kernels.widest(), width);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> anywhere(-40.0, 40.0);
        std::vector<double> errors(std::size_t(width) + 1, 0.0);
        double energy = 0.0;
        for (int n = 0; n < 200; ++n) {
            const std::array<double, 3> at{n % 5 == 0 ? 26.9 : anywhere(random), anywhere(random),
                                           anywhere(random)};
            const auto exact = transformAt(field, layout, at);
            energy += std::norm(exact);
            for (int w = fourier::KernelsByWidth::narrowest; w <= width; ++w)
                errors[std::size_t(w)] += std::norm(spectrum.between(at, kernels.of(w)) - exact);
        }
        EXPECT_LT(std::sqrt(errors[std::size_t(width)] / energy), width == 4 ? 5e-3 : 2e-4);
        for (int w = fourier::KernelsByWidth::narrowest; w < width; ++w) {
            EXPECT_GT(errors[std::size_t(w)], errors[std::size_t(w) + 1]) << w << " of " << width;
            EXPECT_LT(errors[std::size_t(w)], 0.25 * energy) << w << " of " << width;
        }
    }
}

TEST(Spectrum, TakesFourBytesACellAndLittleMoreToMake) {
    const auto kernel = fourier::Kernel::leastAliasing(4, 1.5);
    const volume::VoxelBox box{{0, 0, 0}, {256, 256, 256}};
    fourier::SpectrumLayout layout{{kernel, kernel, kernel}, box, {384, 384, 384}};
    const double cells = 193.0 * 384 * 384;
    // Columns overlap by three of sixteen cells and have a halo: 4 bytes a cell, times 1.4.
    EXPECT_LT(double(layout.bytes()), 1.4 * 4.0 * cells);
    for (const auto storage : {fourier::Storage::binary16, fourier::Storage::float32}) {
        layout.storage = storage;
        EXPECT_LT(double(layout.peakBytes()), 1.25 * double(layout.bytes()));
    }
}

// The cells of a column are written before later slabs are read, whichever is larger.
TEST(Spectrum, CellsOverwriteOnlySlabsThatHaveBeenRead) {
    bool slabsAreLarger = false, cellsAreLarger = false;
    for (const auto storage : {fourier::Storage::binary16, fourier::Storage::float32})
        for (const auto &[box, padded] :
             {std::pair{volume::VoxelBox{{0, 0, 0}, {24, 20, 9}}, volume::GridSize{36, 30, 14}},
              std::pair{volume::VoxelBox{{0, 0, 0}, {24, 64, 64}}, volume::GridSize{30, 80, 80}}}) {
            const auto kernel = fourier::Kernel::exponentialSemicircle(4, 1.0);
            const fourier::SpectrumLayout layout{{kernel, kernel, kernel}, box, padded, storage};
            const fourier::CellLayout cells(layout);
            fourier::ColumnMemory memory(layout, cells);
            const std::size_t column = (layout.bytes() - 64) / std::size_t(cells.columns),
                              slab = std::size_t(box.size().j) * box.size().k * 32 * 4,
                              all = fourier::ColumnMemory::bytes(layout);
            slabsAreLarger = slabsAreLarger || slab > column;
            cellsAreLarger = cellsAreLarger || column > slab;
            for (int c = 0; c < cells.columns; ++c) {
                const auto at =
                    std::size_t(reinterpret_cast<std::byte *>(memory.slab(c)) - memory.cells());
                EXPECT_GE(at, std::size_t(c) * column);
                EXPECT_EQ(at % 64, 0U);
                EXPECT_LE(at + slab, all);
            }
            EXPECT_GE(all, layout.bytes());
            std::fill_n(memory.cells(), all, std::byte(1));
            const auto taken = memory.takeCells();
            for (std::size_t n = 0; n < 64; ++n) {
                EXPECT_EQ(taken[layout.bytes() - 1 - n], std::byte(0));
                EXPECT_EQ(taken[n], std::byte(1));
            }
        }
    EXPECT_TRUE(slabsAreLarger && cellsAreLarger);
}

// The values of a ramp in a box are computed when they are read: everything that reads a field sees
// the same.
TEST(Spectrum, OfARampIsThatOfItsValues) {
    const auto lattice = test::tiltedLattice({21, 18, 15}, {0.7, 0.9, 2.0}, 12);
    const volume::Field ramp =
        volume::Field(test::noiseField(lattice).values.samples(), volume::Ramp{0.2F, 1.5F})
            .within({{2, 1, 3}, {20, 18, 14}});
    const auto kernel = fourier::Kernel::leastAliasing(4, 1.5);
    for (const auto storage : {fourier::Storage::binary16, fourier::Storage::float32}) {
        const fourier::SpectrumLayout layout{
            {kernel, kernel, kernel}, {{1, 1, 2}, {21, 18, 15}}, {30, 28, 24}, storage};
        const Spectrum a = Spectrum::prepare(ramp, layout),
                       b = Spectrum::prepare(ramp.asVolume(), layout);
        EXPECT_EQ(a.dc(), b.dc());
        EXPECT_EQ(a.moments(), b.moments());
        EXPECT_TRUE(std::equal(a.cells(), a.cells() + a.bytes(), b.cells()));
    }
}

TEST(Spectrum, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    const auto field = test::noiseField(volume::Lattice::centred({8, 8, 8}, {1, 1, 1}));
    const auto kernel = fourier::Kernel::exponentialSemicircle(5, 1.5);
    const fourier::SpectrumLayout layout{{kernel, kernel, kernel}, field.support, {16, 16, 16}};
    EXPECT_THROW(Spectrum::prepare(field.values, layout, task::Progress(source.get_token())),
                 task::Cancelled);
}

} // namespace
} // namespace pellucid
