// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "app/bench/measure.h"

namespace pellucid {

namespace {

// The default frame must beat the ray sum. A slow machine passes too, because it slows both. Frames
// and ray sums are timed in blocks, because the ray sum's threads keep the processors busy for a
// while after it ends. The field is of the size of a study: frames grow as the picture, ray sums as
// the volume, and 128^3 fits in the cache of some processors. Measured: 28 to 65 times the speed of
// the ray sum at 256^3 on two threads. Other processes slow some rounds, so the second best of four
// counts.
TEST(Performance, TheDefaultFrameBeatsTheRaySum) {
    const bench::Subject subject = bench::noiseSphere(256);
    const volume::Lattice &lattice = subject.field.values.lattice();
    scene::Scene scene;
    scene.camera = bench::squareCamera(lattice, 256);
    const auto plan = plan::planRender(scene, field::summarise(subject.field));
    render::CpuEngine engine(std::make_shared<const fourier::Spectrum>(
                                 fourier::Spectrum::prepare(subject.field.values, plan.spectrum)),
                             plan.fieldOfView);
    const bench::SpatialVolume inSpace(subject.field.values);
    scene::Camera camera = scene.camera;
    const auto medianOf = [&](const auto &makePicture) {
        std::vector<double> times;
        for (const glm::dquat &view : bench::randomViews(8)) {
            camera.orientation = view;
            const double start = bench::millisecondsNow();
            makePicture();
            times.push_back(bench::millisecondsNow() - start);
        }
        return bench::median(times);
    };
    std::array<double, 4> ratios{};
    for (double &ratio : ratios) {
        const double frame = medianOf([&] { engine.render(camera, scene.image); }),
                     cast = medianOf([&] { bench::raySum(inSpace, camera, 1.0); });
        ratio = cast / frame;
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[2], 5.0);
}

} // namespace
} // namespace pellucid
