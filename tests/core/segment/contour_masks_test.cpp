// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/contour_masks.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/task/error.h"

namespace pellucid {
namespace {

using volume::Coverage;
using volume::Lattice;
using volume::VoxelIndex;
using Contour = std::vector<glm::dvec3>;

constexpr double pi = std::numbers::pi;

Contour circle(glm::dvec3 centre, double radius, glm::dvec3 u, glm::dvec3 v, int points = 400) {
    Contour contour;
    for (int n = 0; n < points; ++n) {
        const double angle = 2.0 * pi * n / points;
        contour.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return contour;
}

segment::PlacedMasks placedOf(const std::vector<Contour> &contours, const Lattice &lattice) {
    std::vector<std::span<const glm::dvec3>> spans(contours.begin(), contours.end());
    const segment::FilledContours planes = segment::filled(spans, lattice);
    return segment::placed(planes.masks, lattice);
}

double volumeOf(const Coverage &coverage, const Lattice &lattice) {
    double sum = 0.0;
    for (const std::uint8_t share : coverage.shares)
        sum += share / 255.0;
    return sum * lattice.cellVolumeMm3();
}

const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

TEST(ContourMasks, FillTheShareOfEachPixel) {
    const Lattice lattice = Lattice::centred({64, 60, 5}, {0.8, 0.9, 3.0});
    const glm::dvec3 middle(2.3, -1.1, lattice.patient(VoxelIndex{0, 0, 2}).mm.z);
    const double radius = 15.3;
    const auto placed = placedOf({circle(middle, radius, x, y)}, lattice);
    EXPECT_FALSE(placed.isResampled);
    const Coverage &coverage = placed.coverages.at(0);
    EXPECT_EQ(coverage.box.lo.k, 2);
    EXPECT_EQ(coverage.box.hi.k, 3);
    // 400 corners cut off 4e-5 of the circle; a share is rounded to 1 of 255.
    EXPECT_NEAR(volumeOf(coverage, lattice) / (pi * radius * radius * 3.0), 1.0, 3e-4);
    double worst = 0.0;
    for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 64; ++i) {
            int inside = 0;
            for (int v = 0; v < 20; ++v)
                for (int u = 0; u < 20; ++u) {
                    const glm::dvec3 at =
                        lattice
                            .patient(volume::VoxelPoint{
                                {i + (u + 0.5) / 20 - 0.5, j + (v + 0.5) / 20 - 0.5, 2.0}})
                            .mm;
                    inside += glm::length(at - middle) < radius;
                }
            worst = std::max(worst, std::abs(inside / 400.0 - coverage.at({i, j, 2}) / 255.0));
        }
    EXPECT_LT(worst, 0.03); // both count points
}

TEST(ContourMasks, AnInnerContourAndAKeyholeAreHoles) {
    const Lattice lattice = Lattice::centred({64, 64, 1}, {1.0, 1.0, 2.0});
    const glm::dvec3 middle(0.2, 0.4, 0.0);
    const double ring = pi * (20.0 * 20.0 - 8.0 * 8.0) * 2.0;
    const Contour outer = circle(middle, 20.0, x, y), inner = circle(middle, 8.0, x, y);
    const auto xored = placedOf({outer, inner}, lattice);
    EXPECT_NEAR(volumeOf(xored.coverages.at(0), lattice) / ring, 1.0, 1e-3);
    // One contour: along the outer circle, through a cut to the inner one, around it, and back.
    Contour keyhole = outer;
    keyhole.push_back(outer.front());
    for (std::size_t n = 0; n <= inner.size(); ++n)
        keyhole.push_back(inner[(inner.size() - n) % inner.size()]);
    const auto cut = placedOf({keyhole}, lattice);
    EXPECT_NEAR(volumeOf(cut.coverages.at(0), lattice) / ring, 1.0, 1e-3);
    EXPECT_EQ(xored.coverages[0], cut.coverages[0]);
}

TEST(ContourMasks, SlicesBetweenContoursAreInterpolated) {
    const Lattice lattice = Lattice::centred({48, 48, 40}, {1.0, 1.0, 1.0});
    std::vector<Contour> contours;
    for (int k = 5; k <= 35; k += 5) // every fifth slice
        contours.push_back(
            circle({0.0, 0.0, lattice.patient(VoxelIndex{0, 0, k}).mm.z}, 12.0, x, y));
    const auto placed = placedOf(contours, lattice);
    EXPECT_TRUE(placed.isResampled);
    EXPECT_NEAR(volumeOf(placed.coverages.at(0), lattice) / (pi * 144.0 * 35.0), 1.0, 5e-3);
    for (int k = 5; k <= 35; ++k)
        EXPECT_EQ(int(placed.coverages[0].at({24, 24, k})), 255) << k;
}

TEST(ContourMasks, ContoursAcrossTheSlicesAreResampled) {
    const Lattice lattice = Lattice::centred({50, 50, 50}, {1.0, 1.0, 1.0});
    std::vector<Contour> sagittal, oblique;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, -0.3, 0.8)),
                     u = glm::normalize(glm::cross(normal, x)), v = glm::cross(normal, u);
    for (int n = -8; n <= 8; ++n) {
        const double radius = std::sqrt(17.0 * 17.0 - 4.0 * n * n);
        if (radius > 0.0 && 2.0 * std::abs(n) < 17.0) {
            sagittal.push_back(circle({2.0 * n, 0.5, -0.5}, radius, y, z));
            oblique.push_back(circle(2.0 * n * normal, radius, u, v));
        }
    }
    const double ball = 4.0 / 3.0 * pi * 17.0 * 17.0 * 17.0;
    for (const auto &contours : {sagittal, oblique}) {
        const auto placed = placedOf(contours, lattice);
        EXPECT_TRUE(placed.isResampled);
        EXPECT_NEAR(volumeOf(placed.coverages.at(0), lattice) / ball, 1.0, 0.02);
    }
}

TEST(ContourMasks, DamagedContoursAreRefused) {
    const Lattice lattice = Lattice::centred({16, 16, 16}, {1.0, 1.0, 1.0});
    const auto refused = [&](const std::vector<Contour> &contours) {
        EXPECT_THROW(placedOf(contours, lattice), task::Error);
    };
    refused({{{0, 0, 0}, {5, 0, 0}, {5, 5, 4}, {0, 5, 0}}});               // not planar
    refused({circle({0, 0, 0}, 5.0, x, y), circle({0, 0, 0}, 5.0, y, z)}); // not parallel
    refused({{{1, 1, 1}, {1, 1, 3}, {1, 1, 5}}});                          // a line across slices
    refused({{{0, 0, 0}, {1e5, 0, 0}, {1e5, 1e5, 0}}});                    // a hundred metres
}

} // namespace
} // namespace pellucid
