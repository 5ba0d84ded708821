// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/measure/measurement.h"
#include "core/task/error.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

using measure::Kind;
using measure::Measurement;

const mpr::Axes axial = mpr::standardAxes(mpr::Orientation::axial);

TEST(Measurement, LengthsAndAnglesAreThoseOfThePatientNotOfThePixels) {
    const auto volume =
        test::noiseField(test::tiltedLattice({12, 12, 12}, {0.5, 0.5, 4}, 25)).values.samples();
    EXPECT_DOUBLE_EQ(
        *measure::measure({Kind::distance, "", {{0, 0, 0}, {2, 3, 6}}, axial}, volume).lengthMm,
        7.0);
    const auto angle = [&](glm::dvec3 a, glm::dvec3 b) {
        return *measure::measure({Kind::angle, "", {a, {1, 1, 1}, b}, axial}, volume).angleDegrees;
    };
    EXPECT_NEAR(angle({3, 1, 1}, {1, 5, 1}), 90.0, 1e-12);
    EXPECT_NEAR(angle({3, 1, 1}, {0, 1, 1}), 180.0, 1e-12);
    // Arc cosine would have lost these digits.
    EXPECT_NEAR(angle({2, 1, 1}, {2, 1 + 1e-7, 1}), 1e-7 * 180 / std::numbers::pi, 1e-12);
}

// The values of a region on a slice are those of its samples, counted out one by one.
TEST(Measurement, RegionsOnASliceCountItsSamples) {
    const auto lattice = volume::Lattice::centred({21, 21, 5}, {0.8, 0.8, 5});
    const auto volume = test::volumeOf(lattice, [](const glm::dvec3 &p) {
        return 100.0 * std::sin(13.0 * p.x + 7.0 * p.y * p.y + p.z);
    });
    // Between two slices, nearer to the middle one; corners in whatever order.
    const Measurement ellipse{Kind::ellipse, "", {{4, -3, 1.2}, {-3, 4, 1.2}}, axial};
    double sum = 0.0, squares = 0.0;
    std::size_t count = 0;
    for (int j = 0; j < 21; ++j)
        for (int i = 0; i < 21; ++i) {
            const glm::dvec3 p = lattice.patient(volume::VoxelIndex{i, j, 2}).mm;
            const double x = (p.x - 0.5) / 3.5, y = (p.y - 0.5) / 3.5;
            if (x * x + y * y > 1.0)
                continue;
            ++count;
            sum += volume.value({i, j, 2});
            squares += std::pow(volume.value({i, j, 2}), 2);
        }
    const auto result = measure::measure(ellipse, volume);
    ASSERT_TRUE(result.values);
    EXPECT_EQ(result.values->count, count);
    EXPECT_TRUE(result.values->areSamples);
    const double mean = sum / double(count);
    EXPECT_NEAR(result.values->mean, mean, 1e-9);
    EXPECT_NEAR(result.values->standardDeviation,
                std::sqrt((squares - double(count) * mean * mean) / double(count - 1)), 1e-6);
    EXPECT_NEAR(*result.areaMm2, std::numbers::pi * 3.5 * 3.5, 1e-9);
}

// On a plane across the lattice: a linear function's mean is its value at the centre, its spread
// that of evenly spaced places.
TEST(Measurement, RegionsOnObliquePlanesAreInterpolated) {
    const auto lattice = test::tiltedLattice({40, 40, 24}, {1, 1, 2}, 20);
    const auto volume =
        test::volumeOf(lattice, [](const glm::dvec3 &p) { return 3.0 * p.x + p.y - 2.0 * p.z; });
    const mpr::Axes axes = mpr::PlaneAxes()
                               .turned(mpr::Orientation::axial, 0.4)
                               .turned(mpr::Orientation::coronal, 0.3)
                               .of(mpr::Orientation::sagittal);
    const glm::dvec3 center = lattice.center().mm + glm::dvec3(0.3, -0.4, 0.2);
    const Measurement box{
        Kind::rectangle,
        "",
        {center - 6.2 * axes.right - 4.2 * axes.up, center + 6.2 * axes.right + 4.2 * axes.up},
        axes};
    const auto result = measure::measure(box, volume);
    ASSERT_TRUE(result.values);
    EXPECT_FALSE(result.values->areSamples);
    EXPECT_NEAR(result.values->mean, 3.0 * center.x + center.y - 2.0 * center.z, 1e-3);
    EXPECT_NEAR(*result.areaMm2, 12.4 * 8.4, 1e-9);
    const glm::dvec3 slope(3, 1, -2);
    // 13 x 9 places, 1 mm apart: the variance of n of them is (n^2 - 1) / 12.
    const double variance = (std::pow(glm::dot(slope, axes.right), 2) * (169 - 1) +
                             std::pow(glm::dot(slope, axes.up), 2) * (81 - 1)) /
                            12.0 * 117.0 / 116.0;
    EXPECT_NEAR(result.values->standardDeviation, std::sqrt(variance), 1e-3);
}

TEST(Measurement, ASmallRegionHasAValueAndOneOutsideHasNone) {
    const auto volume =
        test::volumeOf(volume::Lattice::centred({8, 8, 8}, {2, 2, 2}), [](auto) { return 42.0; });
    const auto values = [&](glm::dvec3 a, glm::dvec3 b) {
        return measure::measure({Kind::rectangle, "", {a, b}, axial}, volume).values;
    };
    ASSERT_TRUE(values({0.1, 0.1, 0.1}, {0.2, 0.2, 0.1}));
    EXPECT_EQ(values({0.1, 0.1, 0.1}, {0.2, 0.2, 0.1})->mean, 42.0);
    EXPECT_FALSE(values({100, 100, 0}, {120, 120, 0}));
    EXPECT_FALSE(values({0, 0, 100}, {5, 5, 100}));
    EXPECT_EQ(values({-500, -500, 1}, {500, 500, 1})->count, 64U);
    // A region takes no longer than the volume, however large it is.
    const mpr::Axes oblique =
        mpr::PlaneAxes().turned(mpr::Orientation::coronal, 0.3).of(mpr::Orientation::axial);
    const glm::dvec3 far = 4e6 * (oblique.right + oblique.up);
    EXPECT_EQ(measure::measure({Kind::ellipse, "", {-far, far}, oblique}, volume).values->mean,
              42.0);
}

TEST(Measurement, IsTheSameAfterJson) {
    const std::vector<Measurement> all{
        {Kind::distance, "Aorta, \"wide\"", {{0.1, 1e-7, 3}, {4, 5, 6}}, axial},
        {Kind::angle, "", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, axial},
        {Kind::ellipse,
         "\xe8\x82\x9d",
         {{0, 0, 0}, {1, 1, 0}},
         mpr::PlaneAxes().turned(mpr::Orientation::axial, 0.3).of(mpr::Orientation::sagittal)},
        {Kind::polyline, "Ureter", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 3, 4}}, axial},
        {Kind::cobbAngle, "", {{0, 0, 0}, {1, 0, 0}, {0, 0, 5}, {1, 1, 5}}, axial, true},
        {Kind::arrow, "Stone", {{0, 0, 0}, {1, 1, 0}}, axial},
        {Kind::text, "Left", {{0, 0, 0}}, axial, true},
        {Kind::distance, "p", {{0, 0, 0}, {1, 1, 0}}, axial, true}};
    EXPECT_EQ(measure::measurementsFromJson(measure::toJson(all)), all);
    EXPECT_TRUE(measure::measurementsFromJson(measure::toJson({})).empty());
}

TEST(Measurement, CobbAnglesAreThoseBetweenLines) {
    const volume::Volume volume;
    const auto angle = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
        return *measure::measure({Kind::cobbAngle, "", {a, b, c, d}, axial}, volume).angleDegrees;
    };
    const double tilt = std::tan(33.0 * std::numbers::pi / 180.0);
    // In either direction, and wherever the lines are.
    EXPECT_NEAR(angle({0, 0, 0}, {10, 0, 0}, {3, 50, 0}, {4, 50 + tilt, 0}), 33.0, 1e-9);
    EXPECT_NEAR(angle({0, 0, 0}, {10, 0, 0}, {4, 50 + tilt, 0}, {3, 50, 0}), 33.0, 1e-9);
    EXPECT_NEAR(angle({0, 0, 0}, {10, 0, 0}, {7, 7, 0}, {9, 7, 0}), 0.0, 1e-9);
    EXPECT_NEAR(angle({0, 0, 0}, {10, 0, 0}, {7, 7, 0}, {7, 9, 0}), 90.0, 1e-9);
}

TEST(Measurement, PolylinesAreAsLongAsTheirParts) {
    const volume::Volume volume;
    EXPECT_NEAR(
        *measure::measure(
             {Kind::polyline, "", {{0, 0, 0}, {3, 4, 0}, {3, 4, 12}, {3, 5, 12}}, axial}, volume)
             .lengthMm,
        5.0 + 12.0 + 1.0, 1e-12);
}

TEST(Measurement, AnnotationsHaveNoFigures) {
    const volume::Volume volume;
    const measure::Result result =
        measure::measure({Kind::arrow, "Stone", {{0, 0, 0}, {1, 1, 0}}, axial}, volume);
    EXPECT_FALSE(result.lengthMm || result.angleDegrees || result.areaMm2 || result.values);
}

TEST(Measurement, BadFilesAreRefusedWithAReason) {
    const auto reason = [](const std::string &text) {
        try {
            measure::measurementsFromJson(text);
        } catch (const task::Error &error) {
            EXPECT_EQ(error.code(), task::ErrorCode::unusable);
            return error.reason().english();
        }
        return std::string("accepted");
    };
    const auto one = [](const std::string &m) {
        return R"({"schema": "pellucid-measurements/1", "measurements": [)" + m + "]}";
    };
    for (const char *text : {"", "[]", "{", R"({"schema": 3})", R"({"schema": "other"})"})
        EXPECT_NE(reason(text).find("is not a list of measurements"), std::string::npos) << text;
    EXPECT_EQ(reason(one("3")), "measurement 1: must be an object");
    EXPECT_EQ(reason(one(R"({"kind": "volume"})")),
              "measurement 1: /kind: unknown value 'volume': use one of distance, polyline, "
              "angle, Cobb angle, ellipse, rectangle, arrow, text");
    EXPECT_EQ(reason(one(R"({"kind": "ellipse", "projected": true, "points_mm": [],
                             "right": [1,0,0], "up": [0,1,0]})")),
              "measurement 1: regions are measured in planes, not in projections");
    EXPECT_EQ(reason(one(R"({"kind": "polyline", "points_mm": [[0,0,0]],
                             "right": [1,0,0], "up": [0,1,0]})")),
              "measurement 1: it must have 2 to 1000 points");
    EXPECT_EQ(reason(one(R"({"kind": "angle", "name": 3})")), "measurement 1: /name: must be text");
    EXPECT_EQ(reason(one(R"({"kind": "angle", "points_mm": [[0,0,0],[1,1,1]],
                             "right": [1,0,0], "up": [0,1,0]})")),
              "measurement 1: it must have 3 points");
    EXPECT_EQ(reason(one(R"({"kind": "distance", "points_mm": [[0,0,0],[1,1,1e300]]})")),
              "measurement 1: /points_mm/1/2: is out of range");
    EXPECT_EQ(reason(one(R"({"kind": "distance", "points_mm": [[0,0,0],[1,1,1e8]]})")),
              "measurement 1: /points_mm: is out of range");
    EXPECT_EQ(reason(one(R"({"kind": "distance", "points_mm": [[0,0,0],[1,1]]})")),
              "measurement 1: /points_mm/1: must be three numbers");
    EXPECT_EQ(reason(one(R"({"kind": "distance", "points_mm": [[0,0,0],[1,1,1]]})")),
              "measurement 1: has no right");
    EXPECT_EQ(reason(one(R"({"kind": "distance", "points_mm": [[0,0,0],[1,1,1]],
                             "right": [1,0,0], "up": [1,0,0]})")),
              "measurement 1: its directions are not at right angles");
}

TEST(Measurement, ATableHasARowForEach) {
    const auto volume = test::volumeOf(
        volume::Lattice::centred({8, 8, 8}, {2, 2, 2}), [](auto) { return 42.0; },
        volume::ValueUnit::hounsfield);
    const std::string table =
        measure::toCsv({{Kind::distance, "A, \"b\"", {{0, 0, 0}, {0, 3, 4}}, axial},
                        {Kind::rectangle, "r", {{-3, -3, 1}, {3, 3, 1}}, axial}},
                       volume);
    EXPECT_NE(table.find("\r\n\"A, \"\"b\"\"\",distance,5,,,,,,,,,\"0.000 0.000 0.000; "),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("\r\n\"r\",rectangle,,,36,42,0,42,42,HU,16 samples,"), std::string::npos)
        << table;
}

// A file may name a measurement like a formula. Numbers keep their signs.
TEST(Measurement, ATableContainsNoFormula) {
    const auto volume = test::volumeOf(
        volume::Lattice::centred({8, 8, 8}, {2, 2, 2}), [](auto) { return -12.5; },
        volume::ValueUnit::hounsfield);
    const std::string table = measure::toCsv(
        {{Kind::rectangle, "=HYPERLINK(\"http://x\")", {{-3, -3, 1}, {3, 3, 1}}, axial}}, volume);
    EXPECT_NE(table.find("\r\n\"'=HYPERLINK(\"\"http://x\"\")\",rectangle,,,36,-12.5,0,-12.5,"),
              std::string::npos)
        << table;
}

} // namespace
} // namespace pellucid
