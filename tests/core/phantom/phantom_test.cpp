// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tbb/global_control.h>

#include "core/phantom/ellipsoids.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "core/volume/statistics.h"

namespace pellucid {

namespace {

using phantom::Kind;

volume::Volume small(Kind kind, double tiltRad = 0.0) {
    return phantom::makePhantom(
        kind,
        phantom::phantomLattice(kind, {.size = volume::GridSize{48, 48, 40}, .tiltRad = tiltRad}));
}

// The value of a phantom at a point of the patient, on a lattice fine enough to hit it.
double headHu(const volume::Volume &head, glm::dvec3 mm) {
    const glm::dvec3 v = glm::round(head.lattice().voxel({mm}).v);
    return head.value({int(v.x), int(v.y), int(v.z)});
}

TEST(Phantom, TheHeadHasItsAnatomyWhereItBelongs) {
    const auto head = phantom::makePhantom(
        Kind::head, phantom::phantomLattice(Kind::head, {.size = volume::GridSize{160, 160, 150}}));
    EXPECT_LT(headHu(head, {100, -110, 110}), -950);   // air
    EXPECT_GT(headHu(head, {0, 12, 98}), 300);         // vault
    EXPECT_NEAR(headHu(head, {9, -22, 26}), 5, 40);    // lateral ventricle
    EXPECT_NEAR(headHu(head, {24, -6, 16}), 40, 40);   // lentiform nucleus
    EXPECT_LT(headHu(head, {28, -58, -22}), -800);     // maxillary sinus, left
    EXPECT_LT(headHu(head, {-28, -58, -22}), -800);    // and right
    EXPECT_NEAR(headHu(head, {32, -80, 4}), 12, 40);   // eye
    EXPECT_GT(volume::statistics(head).maximum, 2000); // teeth
}

TEST(Phantom, EveryKindIsMadeOnATiltedLatticeToo) {
    for (const std::string &name : phantom::kindNames()) {
        const auto volume = small(phantom::kindFromName(name), 0.3);
        const auto s = volume::statistics(volume);
        EXPECT_EQ(volume.unit(), volume::ValueUnit::hounsfield) << name;
        EXPECT_GT(s.maximum, 0.0) << name;
        EXPECT_NEAR(volume.lattice().shearRad(), 0.3, 1e-9) << name;
    }
}

TEST(Phantom, TheMetalIsThirtyThousandAndTheCubeIsFull) {
    EXPECT_NEAR(volume::statistics(small(Kind::metal)).maximum, 30000, 100);
    const auto cube = volume::statistics(small(Kind::cube));
    EXPECT_EQ(cube.minimum, 1000);
    EXPECT_EQ(cube.maximum, 1000);
}

TEST(Phantom, TheSameSamplesForAnyNumberOfThreads) {
    const auto make = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<double> values;
        small(Kind::head).visit([&](auto samples) {
            values.assign(samples.begin(), samples.end());
        });
        return values;
    };
    EXPECT_EQ(make(1), make(2));
}

TEST(Phantom, RefusesUnknownNamesAndImpossibleSizes) {
    EXPECT_THROW(phantom::kindFromName("torso"), task::Error);
    EXPECT_THROW(phantom::phantomLattice(Kind::cube, {.size = volume::GridSize{0, 4, 4}}),
                 task::Error);
    EXPECT_THROW(phantom::phantomLattice(Kind::cube, {.spacingMm = glm::dvec3(1, -1, 1)}),
                 task::Error);
    EXPECT_THROW(phantom::phantomLattice(Kind::cube, {.tiltRad = 1.5}), task::Error);
}

TEST(Phantom, TheTiltedLatticeKeepsTheSliceDistance) {
    const auto lattice =
        phantom::phantomLattice(Kind::head, {.spacingMm = glm::dvec3(1, 1, 4), .tiltRad = 0.3});
    EXPECT_NEAR(lattice.sliceDistanceMm(), 4.0, 1e-12);
}

// The closed form against Simpson's rule along the line; the density is a polynomial on each body,
// so the rule is as good as its step: 1e-6 of the peak.
TEST(Ellipsoids, LineIntegralsMatchQuadrature) {
    const auto bodies = phantom::smoothEllipsoids(40.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    for (const glm::dvec3 point :
         {glm::dvec3(0, 0, 0), glm::dvec3(5, 11, -7), glm::dvec3(-12, 3, 9)}) {
        double sum = 0.0;
        const int steps = 4000;
        const double h = 120.0 / steps;
        for (int n = 0; n <= steps; ++n) {
            const double weight = n == 0 || n == steps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0;
            sum +=
                weight * h / 3.0 * phantom::densityAt(bodies, point + (-60.0 + n * h) * direction);
        }
        EXPECT_NEAR(phantom::lineIntegral(bodies, point, direction) / sum, 1.0, 1e-6);
    }
}

} // namespace
} // namespace pellucid
