// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "core/phantom/ellipsoids.h"
#include "core/phantom/phantom.h"
#include "core/reference/direct_sum.h"
#include "core/reference/wide_kernel.h"
#include "tests/support/fields.h"

namespace pellucid {

namespace {

TEST(DirectSum, OneVoxelIsAPhaseFactor) {
    // A single sample 1 at offset x from the centre: D(s) = dV exp(-i 2 pi s.x), nothing else.
    const auto lattice = test::tiltedLattice({5, 4, 3}, {0.7, 0.9, 2.5}, 20.0);
    std::vector<float> samples(60, 0.0F);
    samples[(2 * 4 + 1) * 5 + 3] = 1.0F;
    const volume::Volume field(lattice, samples, volume::ValueUnit::none);
    const glm::dvec3 x = lattice.patient(volume::VoxelIndex{3, 1, 2}).mm - lattice.center().mm;
    const std::vector<glm::dvec3> s{{0, 0, 0}, {0.1, -0.3, 0.21}, {-0.5, 0.02, 0.4}};
    std::vector<std::complex<double>> values(3);
    reference::directSum(field, s, values);
    for (int n = 0; n < 3; ++n) {
        const auto expected =
            std::polar(lattice.cellVolumeMm3(), -2.0 * std::numbers::pi * glm::dot(s[n], x));
        EXPECT_LT(std::abs(values[n] - expected), 1e-13);
    }
}

TEST(WideKernel, AgreesWithTheDirectSum) {
    // The wide kernel's aliases at width 13, padding 2 are near 2e-13 in the middle and grow to
    // 1e-11 toward the faces, along each axis; 1e-10 leaves room for a field that fills its
    // lattice.
    const auto lattice = test::tiltedLattice({17, 12, 9}, {0.8, 1.1, 3.0}, 25.0);
    const auto field = test::noiseField(lattice);
    const reference::WideKernel wide(field.values, field.support);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-0.9, 0.9);
    std::vector<glm::dvec3> s(200);
    for (auto &v : s)
        v = {uniform(random), uniform(random), uniform(random)};
    std::vector<std::complex<double>> a(200), b(200);
    reference::directSum(field.values, s, a);
    wide.sample(s, b);
    double largest = 0.0, scale = 0.0;
    for (int n = 0; n < 200; ++n) {
        largest = std::max(largest, std::abs(a[n] - b[n]));
        scale = std::max(scale, std::abs(a[n]));
    }
    EXPECT_LT(largest, 1e-10 * scale);
}

TEST(Reference, EllipsoidsMatchTheirAnalyticIntegrals) {
    // (1 - r^2)^4 has a spectrum that falls as 1/k^6, so at 40 samples across the smallest body the
    // cubic reconstruction is good to about 1e-4 and so is the image.
    const auto lattice = volume::Lattice::centred({64, 64, 64}, {1.0, 1.1, 0.9});
    const auto volume = phantom::makePhantom(phantom::Kind::ellipsoids, lattice);
    const classify::FieldWindow window{phantom::ellipsoidBackgroundHu, 2000.0};
    const auto field = classify::densityField(volume, window);
    const reference::WideKernel wide(field.values, field.support);
    const auto bodies = phantom::smoothEllipsoids(phantom::inscribedRadiusMm(lattice));
    scene::Camera camera = scene::defaultCamera(lattice);
    camera.orientation = scene::viewOrientation(scene::StandardView::left, {33, 21, 10});
    const auto image = wide.image(camera, {});
    std::vector<double> truth(image.size());
    const auto axes = camera.axes();
    for (int r = 0; r < camera.height; ++r)
        for (int c = 0; c < camera.width; ++c) {
            const double u = (c - 0.5 * (camera.width - 1)) * camera.pixelMm;
            const double v = (0.5 * (camera.height - 1) - r) * camera.pixelMm;
            truth[std::size_t(r) * camera.width + c] =
                phantom::lineIntegral(bodies, u * axes[0] + v * axes[1], axes[2]) /
                (window.high - window.low);
        }
    EXPECT_LT(test::relativeL2(image, truth), 5e-4);
}

} // namespace
} // namespace pellucid
