// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/box_outline.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace pellucid::mpr {

namespace {

// 101 x 101 pixels of 1 mm about the origin.
Plane through(Orientation orientation, double depthMm = 0.0) {
    Plane plane;
    plane.axes = standardAxes(orientation);
    plane.center = {depthMm * scrollAxis(plane.axes, orientation)};
    plane.width = plane.height = 101;
    return plane;
}

double area(const std::vector<BoxEdge> &edges) {
    double twice = 0.0;
    for (const BoxEdge &e : edges)
        twice += e.from.x * e.to.y - e.to.x * e.from.y;
    return 0.5 * std::abs(twice);
}

} // namespace

// Samples at -20, -19, ... 20 mm: voxel coordinate = mm + 20.
TEST(BoxOutline, isTheBoxWhereThePlaneCutsItAndNothingElsewhere) {
    const auto lattice = volume::Lattice::centred({41, 41, 41}, {1.0, 1.0, 1.0});
    const LatticeBox box{{10.0, 5.0, 15.0}, {30.0, 35.0, 25.0}};
    const auto axial = boxOutline(lattice, box, through(Orientation::axial));
    ASSERT_EQ(axial.size(), 4U);
    EXPECT_NEAR(area(axial), 20.0 * 30.0, 1e-9);
    // All four are faces of the box, each once; x = -10 mm is pixel 40.
    int faces = 0;
    for (const BoxEdge &e : axial) {
        faces |= 1 << (2 * e.axis + (e.isHigh ? 1 : 0));
        if (e.axis == 0 && !e.isHigh) {
            EXPECT_NEAR(e.from.x, 40.0, 1e-9);
            EXPECT_NEAR(e.to.x, 40.0, 1e-9);
        }
    }
    EXPECT_EQ(faces, 0b1111);
    EXPECT_NEAR(area(boxOutline(lattice, box, through(Orientation::coronal))), 20.0 * 10.0, 1e-9);
    EXPECT_TRUE(boxOutline(lattice, box, through(Orientation::axial, 6.0)).empty());
    EXPECT_FALSE(boxOutline(lattice, box, through(Orientation::axial, 4.9)).empty());
}

TEST(BoxOutline, ofATiltedScanLeansAndWhatIsBeyondThePictureIsItsBorder) {
    const double shear = std::tan(0.3);
    const auto lattice = volume::Lattice::make({41, 41, 41}, {{-20.0, -20.0 - 20.0 * shear, -20.0}},
                                               {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, shear, 1}});
    const auto edges =
        boxOutline(lattice, {{0, 10, 0}, {40, 30, 40}}, through(Orientation::sagittal));
    ASSERT_EQ(edges.size(), 4U);
    EXPECT_NEAR(area(edges), 20.0 * 40.0, 1e-9); // sheared, with the same area
    int leaning = 0;
    for (const BoxEdge &e : edges)
        if (e.axis == 1) {
            EXPECT_NEAR(std::abs((e.to.x - e.from.x) / (e.to.y - e.from.y)), shear, 1e-9);
            ++leaning;
        }
    EXPECT_EQ(leaning, 2);
    Plane close = through(Orientation::axial);
    close.width = close.height = 11; // inside the box
    const auto borders = boxOutline(lattice, {{0, 0, 0}, {40, 40, 40}}, close);
    ASSERT_EQ(borders.size(), 4U);
    EXPECT_TRUE(
        std::all_of(borders.begin(), borders.end(), [](const BoxEdge &e) { return e.axis == -1; }));
}

} // namespace pellucid::mpr
