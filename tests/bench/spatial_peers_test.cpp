// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "app/bench/measure.h"

namespace pellucid {

namespace {

double sum(const std::vector<float> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

bench::Subject head() {
    return bench::phantomSubject("head", phantom::Kind::head,
                                 {.size = volume::GridSize{48, 52, 40}, .tiltRad = 0.2});
}

// The ray sum is an honest peer: finer steps bring it closer to the exact projection of the
// trilinear field. The rest of the difference is the roll-off, which rays through points do not
// have.
TEST(RaySum, ConvergesToTheExactLinearProjection) {
    const bench::Subject subject = head();
    const volume::Lattice &lattice = subject.field.values.lattice();
    const bench::SpatialVolume volume(subject.field.values);
    const scene::Camera camera = scene::defaultCamera(lattice);
    bench::Truth truth(subject, camera, 4);
    for (int view = 0; view < truth.views(); ++view) {
        const auto &exact = truth.image(view, {scene::Reconstruction::linear, 0.05});
        const auto at = [&](double step) {
            const auto image = bench::raySum(volume, truth.camera(view), step);
            return bench::compare(image.samples, exact).relativeL2;
        };
        EXPECT_LT(at(lattice.shortestStepMm() / 8.0), 0.03);
        EXPECT_LT(at(lattice.shortestStepMm() / 8.0), 1.1 * at(lattice.shortestStepMm()));
    }
}

// Each voxel is added once, whatever the view: the sum of the image is that of the volume, up to
// the rounding of 12-bit values by 16-bit weights.
TEST(ShearWarpSum, ConservesTheSumForEveryView) {
    const bench::Subject subject = head();
    const bench::SpatialVolume volume(subject.field.values);
    double mass = 0.0;
    subject.field.values.asVolume().visit([&](auto samples) {
        for (const auto f : samples)
            mass += double(f);
    });
    scene::Camera camera = scene::defaultCamera(subject.field.values.lattice());
    for (const glm::dquat &view : bench::randomViews(12)) {
        camera.orientation = view;
        EXPECT_NEAR(sum(bench::shearWarpSum(volume, camera).samples) / mass, 1.0, 2e-3);
    }
}

} // namespace
} // namespace pellucid
