// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "app/bench/adaptive_slice.h"
#include "app/bench/measure.h"

namespace pellucid {

namespace {

// The corrected bound of Totsuka and Levoy's equation 16 holds for every slice, and the looser it
// is the fewer cells are read.
TEST(AdaptiveSlice, StaysWithinItsBoundAndSavesCells) {
    const bench::Subject subject =
        bench::phantomSubject("head", phantom::Kind::head, {.size = volume::GridSize{48, 48, 48}});
    render::Scene scene;
    scene.camera = render::defaultCamera(subject.field.values.lattice());
    scene.interpolation = {fourier::kernelFromName("ES3"), 1.25, fourier::Storage::float32};
    const auto plan = render::planRender(scene, render::summarise(subject.field));
    const auto spectrum = fourier::Spectrum::prepare(subject.field.values, plan.spectrum);
    bench::AdaptiveSlice slices(spectrum);
    for (const glm::dquat &view : bench::randomViews(4)) {
        scene.camera.orientation = view;
        const auto exact = slices.extract(scene.camera, 96, 0.0);
        EXPECT_EQ(exact.cellsRead, 27 * exact.frequencies);
        std::size_t before = exact.cellsRead;
        for (const double bound : {0.01, 0.1, 1.0}) {
            const auto saving = slices.extract(scene.camera, 96, bound);
            double difference = 0.0, energy = 0.0;
            for (std::size_t n = 0; n < exact.samples.size(); ++n) {
                difference += double(std::norm(saving.samples[n] - exact.samples[n]));
                energy += double(std::norm(exact.samples[n]));
            }
            EXPECT_LE(std::sqrt(difference / energy), bound);
            EXPECT_LE(saving.cellsRead, before);
            before = saving.cellsRead;
        }
        EXPECT_LT(before, exact.cellsRead / 2);
    }
}

} // namespace
} // namespace pellucid
