// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "app/bench/look_rows.h"
#include "app/bench/measure.h"
#include "app/bench/suites.h"
#include "core/phantom/phantom.h"
#include "core/prepare/prepared_engine.h"

namespace pellucid::bench {

namespace {

constexpr int frames = 48;
constexpr std::array<std::array<int, 2>, 3> panes{{{600, 760}, {1200, 1500}, {1800, 2000}}};

// The volume fits each pane, as in the window, so larger panes have finer pixels.
void measurePanes(const Report &report, const std::string &name, const volume::Volume &volume,
                  const classify::Look &look, const shading::Shading &shading) {
    const auto shown =
        classify::shownFields(volume, classify::defaultFieldWindow(volume), look, nullptr);
    double smallestMs = 0.0;
    for (const auto &[width, height] : panes) {
        scene::Scene scene;
        scene.look = look;
        scene.shading = shading;
        scene.plannedFor = scene::PlannedFor::volume;
        scene.camera.width = width;
        scene.camera.height = height;
        scene.camera.pixelMm = 2.0 * volume.lattice().radiusMm() / width;
        auto prepared = prepare::prepareEngine({scene, shown});
        Row row = plannedRow("panes", fmt::format("{}, {} x {}", name, width, height),
                             volume.lattice().size(), prepared.plan, scene, 0);
        fillTimes(row, *prepared.engine, scene, frames);
        if (smallestMs == 0.0)
            smallestMs = *row.frameMs;
        row.note = fmt::format("{:.2f} times the first pane's", *row.frameMs / smallestMs);
        report(row);
    }
}

} // namespace

void runPanesSuite(const Report &report) {
    const classify::Look colored = boneAndSoftTissue();
    shading::Shading lit;
    lit.lights = {{.direction = {0.5, 0.5, 1.0}}};
    for (const auto &[name, kind, size] :
         {std::tuple("head", phantom::Kind::head, volume::GridSize{256, 256, 256}),
          std::tuple("chest", phantom::Kind::chest, volume::GridSize{512, 512, 64})}) {
        const volume::Volume volume =
            phantom::makePhantom(kind, phantom::phantomLattice(kind, {.size = size}));
        measurePanes(report, std::string(name) + ", plain", volume, {}, {});
        measurePanes(report, std::string(name) + ", two colors", volume, colored, {});
        measurePanes(report, std::string(name) + ", one light", volume, {}, lit);
    }
}

} // namespace pellucid::bench
