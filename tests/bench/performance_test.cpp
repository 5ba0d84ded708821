// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "app/bench/measure.h"

namespace pellucid {

namespace {

// The default frame is worth its trouble: a floor that a slow machine does not reach by being slow,
// for both sides run on it, and in turns. Measured: 15 to 22 times the ray sum at 128^3 on two
// threads of AVX-512; the floor leaves a neighbour on the machine half of that, and a fifth.
TEST(Performance, TheDefaultFrameBeatsTheRaySum) {
    const bench::Subject subject = bench::noiseSphere(128);
    const volume::Lattice &lattice = subject.field.values.lattice();
    scene::Scene scene;
    scene.camera = bench::squareCamera(lattice, 128);
    const auto plan = plan::planRender(scene, plan::summarise(subject.field));
    render::CpuEngine engine(std::make_shared<const fourier::Spectrum>(
                                 fourier::Spectrum::prepare(subject.field.values, plan.spectrum)),
                             plan.fieldOfView);
    const bench::SpatialVolume inSpace(subject.field.values);
    std::vector<double> frame, cast;
    scene::Camera camera = scene.camera;
    for (const glm::dquat &view : bench::randomViews(64)) {
        camera.orientation = view;
        double start = bench::millisecondsNow();
        engine.render(camera, scene.image);
        frame.push_back(bench::millisecondsNow() - start);
        start = bench::millisecondsNow();
        bench::raySum(inSpace, camera, 1.0);
        cast.push_back(bench::millisecondsNow() - start);
    }
    EXPECT_GT(bench::median(cast) / bench::median(frame), 6.0);
}

} // namespace
} // namespace pellucid
