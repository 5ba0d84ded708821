// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/mpr/reslice.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using mpr::Orientation;

// Trilinear interpolation reproduces a linear function of the position exactly, on any lattice.
TEST(Reslice, ReproducesALinearFunctionOnATiltedLattice) {
    const auto lattice = test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 25);
    const auto linear = [](const glm::dvec3 &p) {
        return 3.0 + 0.5 * p.x - 2.0 * p.y + 0.25 * p.z;
    };
    const volume::Volume volume = test::volumeOf(lattice, linear);
    for (const auto orientation :
         {Orientation::axial, Orientation::coronal, Orientation::sagittal}) {
        const mpr::Plane plane{lattice.center(), mpr::standardAxes(orientation), 0.8, 21, 17};
        const auto image = mpr::reslice(volume, plane);
        int inside = 0;
        for (int r = 0; r < 17; ++r)
            for (int c = 0; c < 21; ++c) {
                const glm::dvec3 v = lattice.voxel(plane.at(c, r)).v;
                const bool within =
                    v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x <= 29 && v.y <= 27 && v.z <= 11;
                if (!within)
                    continue;
                ++inside;
                EXPECT_NEAR(image.values[r * 21 + c], linear(plane.at(c, r).mm), 1e-4);
            }
        EXPECT_GT(inside, 100);
    }
}

TEST(Reslice, OutsideTheVolumeThereIsNothing) {
    const auto field = test::noiseField(volume::Lattice::centred({4, 4, 4}, {1, 1, 1}));
    EXPECT_TRUE(std::isnan(mpr::valueAt(field.values.samples(), {{0, 0, 2.1}})));
    EXPECT_FALSE(std::isnan(
        mpr::valueAt(field.values.samples(), {{0, 0, 1.9}}))); // half a sample beyond the centre
}

TEST(Reslice, PlanesFollowTheRadiologicalConvention) {
    mpr::Plane plane{{}, mpr::standardAxes(Orientation::axial), 1.0, 11, 11};
    EXPECT_EQ(plane.at(0, 5).mm, glm::dvec3(-5, 0, 0)); // image left is the patient's right
    EXPECT_EQ(plane.at(5, 0).mm, glm::dvec3(0, -5, 0)); // up is anterior
    plane.axes = mpr::standardAxes(Orientation::coronal);
    EXPECT_EQ(plane.at(0, 0).mm, glm::dvec3(-5, 0, 5));
    plane.axes = mpr::standardAxes(Orientation::sagittal);
    EXPECT_EQ(plane.at(0, 0).mm, glm::dvec3(0, -5, 5)); // image left is anterior
    EXPECT_EQ(plane.pixel({{0, 2, 3}}), glm::dvec2(7, 2));
    const mpr::PlaneAxes planes;
    EXPECT_EQ(planes.scrollAxis(Orientation::axial), glm::dvec3(0, 0, 1));
    EXPECT_EQ(planes.scrollAxis(Orientation::coronal), glm::dvec3(0, 1, 0));
    EXPECT_EQ(planes.scrollAxis(Orientation::sagittal), glm::dvec3(1, 0, 0));
}

TEST(Reslice, ScrollingStepsFromSliceToSlice) {
    const auto lattice = test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 0);
    const mpr::PlaneAxes planes;
    const auto range = mpr::scrollRange(lattice, planes.scrollAxis(Orientation::axial));
    EXPECT_NEAR(range.stepMm, 3.0, 1e-12);
    EXPECT_NEAR(mpr::scrollRange(lattice, planes.scrollAxis(Orientation::sagittal)).stepMm, 1.0,
                1e-12);
    EXPECT_NEAR(range.highMm - range.lowMm, 33.0, 1e-12);
    EXPECT_TRUE(range.hasSlices);
    // From between two slices onto a slice, and not beyond the last one.
    EXPECT_NEAR(range.moved(range.lowMm + 4.4, 1), range.lowMm + 6.0, 1e-12);
    EXPECT_NEAR(range.moved(range.lowMm + 6.0, -1), range.lowMm + 3.0, 1e-12);
    EXPECT_NEAR(range.moved(range.lowMm + 6.0, 100), range.highMm, 1e-12);
    EXPECT_FALSE(
        mpr::scrollRange(test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 20), {0, 0, 1}).hasSlices);
}

// A plane turned about its own normal keeps its picture. The others stay at right angles to it,
// however often they are turned.
TEST(Reslice, TurnedPlanesStayAtRightAngles) {
    mpr::PlaneAxes planes;
    for (int n = 0; n < 300; ++n)
        planes = planes.turned(mpr::allOrientations[std::size_t(n % 3)], 0.1 + 0.01 * n);
    EXPECT_FALSE(planes.areStandard());
    for (const auto a : mpr::allOrientations) {
        EXPECT_NEAR(glm::dot(planes.of(a).right, planes.of(a).up), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(planes.of(a).toViewer()), 1.0, 1e-12);
        for (const auto b : mpr::allOrientations)
            EXPECT_NEAR(glm::dot(planes.scrollAxis(a), planes.scrollAxis(b)), a == b ? 1.0 : 0.0,
                        1e-12);
    }
    const mpr::PlaneAxes quarter = mpr::PlaneAxes().turned(Orientation::axial, std::acos(-1.0) / 2);
    EXPECT_EQ(quarter.of(Orientation::axial), mpr::standardAxes(Orientation::axial));
    // Counterclockwise as seen from the feet, the right of a coronal image turns from left to
    // front.
    EXPECT_NEAR(glm::distance(quarter.of(Orientation::coronal).right, glm::dvec3(0, -1, 0)), 0.0,
                1e-12);
}

// A slab equals samples computed one by one.
TEST(Reslice, SlabsOnSlicesHaveTheExtremesOfTheirSamplesAndTheIntegralBetweenThem) {
    const auto volume =
        test::noiseField(volume::Lattice::centred({9, 8, 11}, {1, 1, 2})).values.samples();
    const volume::Lattice &lattice = volume.lattice();
    const mpr::Plane plane{lattice.patient(volume::VoxelIndex{4, 4, 5}),
                           mpr::standardAxes(Orientation::axial), 1.0, 1, 1};
    const auto sample = [&](int k) { return volume.value({4, 4, k}); };
    const auto slab = [&](double thicknessMm, mpr::SlabMode mode) {
        return double(mpr::reslice(volume, plane, {.slab = {thicknessMm, mode}}).values[0]);
    };
    EXPECT_NEAR(slab(0.0, mpr::SlabMode::mean), sample(5), 1e-6);
    double most = -1e9, least = 1e9;
    for (int k = 3; k <= 7; ++k) {
        most = std::max(most, sample(k));
        least = std::min(least, sample(k));
    }
    EXPECT_NEAR(slab(8.0, mpr::SlabMode::maximum), most, 1e-6);
    EXPECT_NEAR(slab(8.0, mpr::SlabMode::minimum), least, 1e-6);
    EXPECT_NEAR(slab(8.0, mpr::SlabMode::mean),
                (0.5 * sample(3) + sample(4) + sample(5) + sample(6) + 0.5 * sample(7)) / 4.0,
                1e-6);
    // Faces between slices: what is between samples counts with them.
    const double face = 0.5 * (sample(4) + sample(5)), other = 0.5 * (sample(5) + sample(6));
    EXPECT_NEAR(slab(2.0, mpr::SlabMode::maximum), std::max({face, other, sample(5)}), 1e-6);
    EXPECT_NEAR(slab(2.0, mpr::SlabMode::mean), 0.25 * face + 0.5 * sample(5) + 0.25 * other, 1e-6);
    // Beyond the volume only the part inside counts.
    EXPECT_FALSE(std::isnan(slab(100.0, mpr::SlabMode::mean)));
    double total = 0.0;
    for (int k = 0; k < 11; ++k)
        total += sample(k);
    EXPECT_NEAR(slab(100.0, mpr::SlabMode::mean), total / 11.0, 1e-6);
}

// The vector code is compared with single points: for integers and floats, more than one tile,
// lanes along rows, columns and the slab, and the edges of the volume.
TEST(Reslice, IsWhatItsPointsAre) {
    const auto lattice = test::tiltedLattice({40, 33, 21}, {1, 1, 2}, 15);
    const auto noise = test::noiseField(lattice).values;
    std::vector<std::int16_t> whole;
    std::vector<float> floats;
    for (int k = 0; k < 21; ++k)
        for (int j = 0; j < 33; ++j)
            for (int i = 0; i < 40; ++i) {
                const double v = 2000.0 * noise.value({i, j, k}) - 1000.0;
                whole.push_back(std::int16_t(v));
                floats.push_back(float(v));
            }
    const mpr::PlaneAxes turned =
        mpr::PlaneAxes().turned(Orientation::axial, 0.5).turned(Orientation::sagittal, 0.7);
    std::vector<mpr::Axes> ways{turned.of(Orientation::coronal), turned.of(Orientation::axial)};
    for (const auto o : mpr::allOrientations)
        ways.push_back(mpr::standardAxes(o));
    ways.push_back({{0, 0, 1}, {1, 0, 0}}); // columns along the rows of the volume
    for (const volume::Volume &volume : {volume::Volume(lattice, whole, volume::ValueUnit::none),
                                         volume::Volume(lattice, floats, volume::ValueUnit::none)})
        for (const mpr::Axes &axes : ways) {
            const mpr::Plane plane{lattice.center(), axes, 0.7, 70, 40};
            const auto thin = mpr::reslice(volume, plane);
            // A hundred places from one face of a slab to the other: its maximum is no less.
            const double mm = 6.0;
            const auto slab = mpr::reslice(volume, plane, {.slab = {mm, mpr::SlabMode::maximum}});
            int inside = 0;
            for (int r = 0; r < plane.height; ++r)
                for (int c = 0; c < plane.width; ++c) {
                    const std::size_t n = std::size_t(r) * plane.width + std::size_t(c);
                    const float value = mpr::valueAt(volume, plane.at(c, r));
                    ASSERT_EQ(std::isnan(thin.values[n]), std::isnan(value)) << r << " " << c;
                    if (std::isnan(value))
                        continue;
                    ++inside;
                    // Places in single precision, a line of 32 long: 1e-5 of a step of 2000.
                    ASSERT_NEAR(thin.values[n], value, 0.05);
                    ASSERT_GE(slab.values[n], value - 0.05);
                    for (const double face : {-0.5 * mm, 0.5 * mm}) {
                        const float at = mpr::valueAt(
                            volume, {plane.at(c, r).mm + face * plane.axes.toViewer()});
                        if (!std::isnan(at)) {
                            ASSERT_GE(slab.values[n], at - 0.05);
                        }
                    }
                }
            EXPECT_GT(inside, 500);
        }
}

TEST(Reslice, PlanesFaceAnyDirectionTogether) {
    const mpr::Axes wanted = mpr::PlaneAxes()
                                 .turned(Orientation::axial, 0.8)
                                 .turned(Orientation::coronal, -0.4)
                                 .of(Orientation::sagittal);
    const mpr::PlaneAxes planes = mpr::PlaneAxes().facing(wanted);
    double nearest = 0.0;
    for (const auto a : mpr::allOrientations) {
        nearest = std::max(nearest, std::abs(glm::dot(planes.scrollAxis(a), wanted.toViewer())));
        for (const auto b : mpr::allOrientations)
            EXPECT_NEAR(glm::dot(planes.scrollAxis(a), planes.scrollAxis(b)), a == b ? 1.0 : 0.0,
                        1e-12);
    }
    EXPECT_NEAR(nearest, 1.0, 1e-12);
}

TEST(Reslice, NearestShowsTheSamplesThemselves) {
    const auto volume =
        test::noiseField(test::tiltedLattice({6, 5, 4}, {1, 1, 3}, 20)).values.samples();
    const volume::Lattice &lattice = volume.lattice();
    const auto at = [&](const glm::dvec3 &v) {
        return double(mpr::valueAt(volume, lattice.patient(volume::VoxelPoint{v}),
                                   mpr::Interpolation::nearest));
    };
    EXPECT_EQ(at({2.4, 3.4, 1.6}), volume.value({2, 3, 2}));
    EXPECT_EQ(at({5.49, 4.49, 3.49}), volume.value({5, 4, 3}));
    EXPECT_EQ(at({-0.49, 0.0, 0.0}), volume.value({0, 0, 0}));
    EXPECT_TRUE(std::isnan(at({-0.51, 0.0, 0.0})));
}

TEST(Reslice, OneSampleFillsItsCell) {
    const volume::Volume one(volume::Lattice::centred({1, 1, 1}, {2, 2, 2}),
                             std::vector<float>{7.0F}, volume::ValueUnit::none);
    EXPECT_EQ(mpr::valueAt(one, {{0.9, -0.9, 0.9}}), 7.0F);
}

// A plane of a tilted scan shows the slices as they were taken, row for row.
TEST(PlaneAxes, AlongTheScanShowsItsSlices) {
    const auto lattice = test::tiltedLattice({30, 28, 12}, {1, 1, 3}, 25);
    const auto axes = mpr::PlaneAxes::along(lattice);
    const mpr::Axes &axial = axes.of(Orientation::axial);
    EXPECT_NEAR(std::abs(glm::dot(axial.right, glm::normalize(lattice.step(0)))), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(axial.up, glm::normalize(lattice.step(1)))), 1.0, 1e-12);
    EXPECT_NO_THROW(mpr::PlaneAxes({axes.of(Orientation::axial), axes.of(Orientation::coronal),
                                    axes.of(Orientation::sagittal)}));
    // Turned by any angle, too, and always the same way up.
    for (double angle = 0.1; angle < 6.3; angle += 0.37) {
        const double c = std::cos(angle), s = std::sin(angle);
        const auto turned = volume::Lattice::make(
            {20, 20, 5}, {{0, 0, 0}},
            {glm::dvec3(c, s, 0.2), glm::dvec3(-s, c, 0.1), glm::dvec3(0.0, 0.1, 2.0)});
        const auto planes = mpr::PlaneAxes::along(turned);
        const mpr::Axes &shown = planes.of(Orientation::axial);
        EXPECT_GT(glm::dot(shown.right, glm::dvec3(1, 0, 0)), 0.65) << angle;
        EXPECT_LT(std::abs(glm::dot(shown.toViewer(), glm::normalize(turned.step(0)))), 1e-9);
    }
}

} // namespace
} // namespace pellucid
