// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the spectrum against fields whose transform is known in closed form.
#include "core/render/spectrum_slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/fourier/transforms/padded_size.h"
#include "core/render/reasons.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

constexpr double pi = std::numbers::pi;
const double decibelsPerNeper = 20.0 / std::log(10.0);

fourier::SpectrumLayout layoutOf(const volume::Lattice &lattice, const fourier::Kernel &kernel,
                                 double padding) {
    const volume::GridSize n = lattice.size();
    return {{kernel, kernel, kernel},
            lattice.bounds(),
            {fourier::paddedSize(n.i, padding), fourier::paddedSize(n.j, padding),
             fourier::paddedSize(n.k, padding)},
            fourier::Storage::float32};
}

// A Kaiser-Bessel kernel of width w at padding p leaves exp(-pi w sqrt(1 - 1/p)) of what a field
// sums to (Beatty 2005, Barnett 2019), 1.8e-7 for 7 and 2, from each of two neighbouring periods
// along three axes: 1.1e-6. A transform in floats adds less than that.
constexpr double kernelError = 2e-6;

fourier::SpectrumLayout exactLayout(const volume::Lattice &lattice) {
    return layoutOf(lattice, fourier::Kernel::kaiserBessel(7, 2.0), 2.0);
}

render::EngineParts
partsOf(const std::vector<volume::Volume> &fields, const fourier::SpectrumLayout &layout,
        std::vector<render::ChannelWeights> channelWeights = {{1.0, 1.0, 1.0}}) {
    render::EngineParts parts{
        {}, std::move(channelWeights), plan::fieldOfViewOf(fields.front().lattice(), layout.box)};
    for (const volume::Volume &field : fields)
        parts.spectra.fields.push_back(
            std::make_shared<const fourier::Spectrum>(fourier::Spectrum::prepare(field, layout)));
    return parts;
}

scene::Camera obliqueCamera(double pixelMm) {
    scene::Camera camera;
    camera.orientation = scene::viewOrientation(scene::StandardView::front, {31.0, 17.0, 8.0});
    camera.pixelMm = pixelMm;
    return camera;
}

// The frequency of a row and column, as the declaration says.
glm::dvec3 frequencyAt(const render::SpectrumSlice &slice, const scene::Camera &camera, int row,
                       int column) {
    const glm::dmat3 axes = camera.axes();
    return slice.stepPerMm *
           (double(column - slice.side / 2) * axes[0] - double(row - slice.side / 2) * axes[1]);
}

float at(const render::SpectrumSlice &slice, int row, int column) {
    return slice.decibels[std::size_t(row) * std::size_t(slice.side) + std::size_t(column)];
}

volume::Volume oneVoxel(const volume::Lattice &lattice, const volume::VoxelIndex &where) {
    const glm::dvec3 place = lattice.patient(where).mm;
    return test::volumeOf(
        lattice, [&](const glm::dvec3 &mm) { return glm::distance(mm, place) < 0.1 ? 1.0 : 0.0; });
}

// A Gaussian with principal axes of its own.
struct Gaussian {
    glm::dvec3 centre;
    glm::dmat3 covariance; ///< mm^2
    double operator()(const glm::dvec3 &mm) const {
        const glm::dvec3 r = mm - centre;
        return std::exp(-0.5 * glm::dot(r, glm::inverse(covariance) * r));
    }
    // Its transform is exp(-2 pi^2 s^T C s), times that of frequency 0.
    double decibels(const glm::dvec3 &s) const {
        return -decibelsPerNeper * 2.0 * pi * pi * glm::dot(s, covariance * s);
    }
};

Gaussian gaussianIn(const volume::Lattice &lattice, const glm::dvec3 &sigmaMm) {
    const glm::dmat3 axes =
        glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    const glm::dmat3 squares(glm::dvec3(sigmaMm.x * sigmaMm.x, 0, 0),
                             glm::dvec3(0, sigmaMm.y * sigmaMm.y, 0),
                             glm::dvec3(0, 0, sigmaMm.z * sigmaMm.z));
    return {lattice.center().mm, axes * squares * glm::transpose(axes)};
}

} // namespace

// Its magnitude is the same at every frequency, beyond the lattice's own band too: the slices are
// 5 mm apart, a pixel is 0.8 mm.
TEST(SpectrumSlice, OfOneVoxelIsFlat) {
    const auto lattice = test::tiltedLattice({9, 8, 7}, {0.8, 0.9, 5.0}, 15.0);
    const auto parts = partsOf({oneVoxel(lattice, {2, 3, 5})}, exactLayout(lattice));
    for (const int side : {64, 33}) {
        const auto slice = render::spectrumSlice(parts, obliqueCamera(0.8), side);
        ASSERT_EQ(slice.decibels.size(), std::size_t(side) * std::size_t(side));
        EXPECT_DOUBLE_EQ(slice.stepPerMm, 1.0 / (side * 0.8));
        EXPECT_DOUBLE_EQ(slice.limitPerMm, 0.625);
        EXPECT_EQ(at(slice, side / 2, side / 2), 0.0F);
        // 8.7 dB for a factor of e.
        for (const float decibels : slice.decibels)
            ASSERT_NEAR(decibels, 0.0, decibelsPerNeper * kernelError);
    }
}

// A parabola in every direction. Its axes lie askew to the lattice, to the patient and to the
// picture, so that a row or column taken for another one shows.
TEST(SpectrumSlice, OfAGaussianIsAParabolaInDecibels) {
    const auto lattice = test::tiltedLattice({54, 52, 40}, {1.0, 1.1, 1.5}, 12.0);
    const Gaussian gaussian = gaussianIn(lattice, {2.2, 3.0, 4.0});
    const auto parts = partsOf({test::volumeOf(lattice, gaussian)}, exactLayout(lattice));
    const auto camera = obliqueCamera(2.0);
    const auto slice = render::spectrumSlice(parts, camera, 48);
    int compared = 0;
    for (int row = 0; row < slice.side; ++row)
        for (int column = 0; column < slice.side; ++column) {
            const double expected = gaussian.decibels(frequencyAt(slice, camera, row, column));
            if (expected < -60.0)
                continue;
            ++compared;
            // The nearest copy of the band lies 0.66 cycles per mm away and has sigma 2.2 mm in its
            // worst direction: below 1e-10 at the 0.17 cycles per mm that 60 dB reach to. What is
            // cut off six sigma away is less than that. So the kernel's error counts alone, over an
            // amplitude of 1e-3 at least.
            const double amplitude = std::pow(10.0, expected / 20.0);
            ASSERT_NEAR(at(slice, row, column), expected,
                        decibelsPerNeper * kernelError / amplitude + 1e-5)
                << row << " " << column;
        }
    EXPECT_GT(compared, 400); // the ellipse of 60 dB, and not its middle alone
}

// What lies between two cells is what the plan's kernel makes of them: halfway between them a tent
// takes their mean. For a voxel n samples from the origin of phase, of a period of P, that is
// cos(pi n/P) of its magnitude, which was divided by the tent's transform sinc^2(n/P) before.
TEST(SpectrumSlice, InterpolatesWithTheKernelOfThePlan) {
    const auto lattice = test::tiltedLattice({16, 1, 1}, {1.0, 1.0, 1.0}, 0.0);
    const auto layout = layoutOf(lattice, fourier::Kernel::trilinear(), 1.0);
    ASSERT_EQ(layout.padded.i, 16);
    scene::Camera camera;
    camera.orientation = scene::viewOrientation(scene::StandardView::front);
    camera.pixelMm = 1.0;
    for (const int n : {2, 5, 7}) {
        const auto parts = partsOf({oneVoxel(lattice, {8 + n, 0, 0})}, layout);
        const auto slice = render::spectrumSlice(parts, camera, 32);
        const double turn = pi * n / 16.0, sinc = std::sin(turn) / turn;
        for (const int column : {1, 3, 15, 17, 31}) // halfway
            EXPECT_NEAR(at(slice, 16, column), 20.0 * std::log10(std::cos(turn) / (sinc * sinc)),
                        1e-4)
                << n;
        for (const int column : {0, 2, 14, 18, 30}) // on a cell
            EXPECT_NEAR(at(slice, 16, column), 20.0 * std::log10(1.0 / (sinc * sinc)), 1e-4) << n;
    }
}

// Classes in color count by their mean share of red, green and blue.
TEST(SpectrumSlice, OfSeveralFieldsIsThatOfTheirWeightedSum) {
    const auto lattice = test::tiltedLattice({12, 14, 10}, {1.0, 1.0, 2.0}, 0.0);
    const auto layout = exactLayout(lattice);
    const volume::Volume first = test::noiseField(lattice, 1).values.samples(),
                         second = test::noiseField(lattice, 2).values.samples(),
                         unseen = test::noiseField(lattice, 3).values.samples();
    std::vector<float> sum;
    first.visit([&](auto a) {
        second.visit([&](auto b) {
            for (std::size_t n = 0; n < a.size(); ++n)
                sum.push_back(float(0.5 * double(a[n]) + 0.25 * double(b[n])));
        });
    });
    const auto camera = obliqueCamera(1.0);
    const auto apart =
        render::spectrumSlice(partsOf({first, second, unseen}, layout,
                                      {{0.5, 0.5, 0.5}, {0.75, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
                              camera, 32);
    const auto together = render::spectrumSlice(
        partsOf({volume::Volume(lattice, sum, volume::ValueUnit::none)}, layout), camera, 32);
    for (std::size_t n = 0; n < apart.decibels.size(); ++n) {
        // Samples and cells are floats: 1e-7 of what the field sums to.
        const double amplitude = std::pow(10.0, together.decibels[n] / 20.0);
        ASSERT_NEAR(apart.decibels[n], together.decibels[n],
                    decibelsPerNeper * 5e-7 / amplitude + 1e-5);
    }
}

TEST(SpectrumSlice, RefusesAnEmptyFieldAndCanBeCancelled) {
    const auto lattice = test::tiltedLattice({8, 8, 8}, {1.0, 1.0, 1.0}, 0.0);
    const auto layout = exactLayout(lattice);
    const auto zero = test::volumeOf(lattice, [](const glm::dvec3 &) { return 0.0; });
    for (const auto &parts :
         {partsOf({zero}, layout), partsOf({oneVoxel(lattice, {4, 4, 4})}, layout, {{0, 0, 0}})})
        try {
            render::spectrumSlice(parts, obliqueCamera(1.0), 16);
            FAIL();
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unusable);
            EXPECT_TRUE(error.reason().is(task::because::nothingVisible)) << error.what();
        }
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(render::spectrumSlice(partsOf({oneVoxel(lattice, {4, 4, 4})}, layout),
                                       obliqueCamera(1.0), 16, task::Progress(stop.get_token())),
                 task::Cancelled);
}

TEST(SpectrumSlice, GreyIsLinearInDecibelsFromBlackToWhite) {
    const render::SpectrumSlice slice{2, 1.0, 1.0, {0.0F, -50.0F, -100.0F, -200.0F}};
    EXPECT_EQ(render::greyLevels(slice),
              (std::vector<std::uint8_t>{255, 255, 255, 255, 128, 128, 128, 255, //
                                         0, 0, 0, 255, 0, 0, 0, 255}));
    // A field with negative samples may be stronger elsewhere than at frequency 0.
    EXPECT_EQ(render::greyLevels({1, 1.0, 1.0, {12.0F}}),
              (std::vector<std::uint8_t>{255, 255, 255, 255}));
}

} // namespace pellucid
