// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <fmt/format.h>

#include "app/bench/look_rows.h"
#include "app/bench/measure.h"
#include "app/bench/suites.h"
#include "core/phantom/phantom.h"
#include "core/picture/compose.h"
#include "core/picture/exposure.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

namespace {

constexpr int width = 1800, height = 2000, frames = 40;

// Measures how much contrast processing adds to a frame, alternating with plain display.
void measureCase(const Report &report, const std::string &name, const volume::Volume &volume,
                 const classify::Look &look, double pixelMm) {
    scene::Scene scene;
    scene.look = look;
    scene.camera.width = width;
    scene.camera.height = height;
    scene.camera.pixelMm = pixelMm;
    scene.plannedFor = scene::PlannedFor::volume;
    const auto prepared = prepare::prepareEngine(
        {scene,
         classify::shownFields(volume, classify::defaultFieldWindow(volume), look, nullptr)});
    render::ProjectionEngine &engine = *prepared.engine;
    const double start = millisecondsNow();
    scene.tone.exposure =
        picture::measureExposure(engine, volume.lattice(), scene.image, scene.shading, scene.tone,
                                 picture::Background::zero);
    const double exposureMs = millisecondsNow() - start;
    std::vector<double> rendering, plain, processed;
    const auto views = randomViews(frames);
    for (const glm::dquat &view : views) {
        scene.camera.orientation = view;
        const picture::Display display = picture::displayOf(scene.tone, view);
        double from = millisecondsNow();
        const auto lap = [&](std::vector<double> &times) {
            const double now = millisecondsNow();
            times.push_back(now - from);
            from = millisecondsNow();
        };
        const auto image = engine.render(scene.camera, scene.image, scene.shading);
        lap(rendering);
        picture::Display withoutContrast = display;
        withoutContrast.contrast.detail = withoutContrast.contrast.latitude = 0.0;
        // The first of the two finds other caches: they take turns.
        const bool isPlainFirst = rendering.size() % 2 == 0;
        for (const bool isPlain : {isPlainFirst, !isPlainFirst}) {
            picture::compose(image, isPlain ? withoutContrast : display, picture::PixelOrder::bgra);
            lap(isPlain ? plain : processed);
        }
    }
    Row row;
    row.suite = "radiograph";
    row.name = name;
    row.size = volume.lattice().size();
    row.frameMs = median(rendering) + median(plain);
    row.note = fmt::format("contrast adds {:.2f} ms, {:.0f} % of render {:.2f} and display {:.2f} "
                           "ms; measuring the exposure {:.1f} ms",
                           median(processed) - median(plain),
                           100.0 * (median(processed) - median(plain)) / *row.frameMs,
                           median(rendering), median(plain), exposureMs);
    report(row);
}

} // namespace

void runRadiographSuite(const Report &report) {
    const volume::Volume volume = phantom::makePhantom(
        phantom::Kind::chest,
        phantom::phantomLattice(phantom::Kind::chest, {.size = volume::GridSize{512, 512, 256}}));
    const classify::Look colored = boneAndSoftTissue();
    const double fits = 2.0 * volume.lattice().radiusMm() / width;
    measureCase(report, "grey, volume fits 1800x2000", volume, {}, fits);
    measureCase(report, "grey, enlarged twice", volume, {}, 0.5 * fits);
    measureCase(report, "two colors, volume fits", volume, colored, fits);
}

} // namespace pellucid::bench
