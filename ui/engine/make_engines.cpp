// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/make_engines.h"

#include <algorithm>
#include <optional>

#include "core/classify/coarse_field.h"
#include "core/classify/layers.h"
#include "core/classify/shown_fields.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "ui/engine/reasons.h"

namespace pellucid::ui {

namespace {

using prepare::Detail;

// Small enough that the coarse projection appears a moment after the volume.
constexpr int coarseSide = 96;

bool isLarge(const volume::Volume &volume) {
    const volume::GridSize n = volume.lattice().size();
    return std::max({n.i, n.j, n.k}) > coarseSide;
}

// One engine serves every view of the pane.
scene::Scene sceneOf(const prepare::PreparedFor &wanted) {
    scene::Scene scene;
    scene.plannedFor = scene::PlannedFor::volume;
    scene.tolerance = wanted.tolerance;
    scene.interpolation = wanted.interpolation;
    scene.image = wanted.image;
    scene.shading.cue = wanted.cue;
    if (wanted.isLit)
        scene.shading.lights.emplace_back();
    return scene;
}

classify::FieldWindow windowOf(const EngineSource &source) {
    return source.wanted.window.value_or(classify::defaultFieldWindow(source.volume));
}

// At full resolution the volume's own window holds, also for a coarse one.
classify::ShownFields fieldsOf(const EngineSource &source, const volume::Volume &volume,
                               const task::Progress &progress) {
    preprocess::ClassRunner runner(*source.steps, source.segments);
    return classify::cropped(
        classify::shownFields(volume, windowOf(source), source.wanted.look, &runner, progress),
        source.wanted.crop);
}

void requireMemory(const EngineSource &source) {
    const std::size_t needed = prepare::bytesForFields(
        source.wanted.look, sceneOf(source.wanted).shading, source.volume.lattice().size());
    if (needed > system::availableMemoryBytes())
        throw task::Error(task::ErrorCode::outOfMemory,
                          task::because::fieldsNeedMemory(needed >> 20));
}

// The engine of the look of a volume: that of the source, or a coarser one.
prepare::PreparedEngine engineOf(const EngineSource &source, const volume::Volume &volume,
                                 const task::Progress &progress) {
    classify::ShownFields fields = fieldsOf(source, volume, progress.part(0.0, 0.2));
    prepare::PreparedEngine engine =
        prepare::prepareEngine({sceneOf(source.wanted),
                                std::move(fields),
                                {system::availableMemoryBytes()},
                                shading::shadingScale(source.volume.lattice())},
                               progress.part(0.2, 1.0));
    engine.study = studyFields(source);
    return engine;
}

} // namespace

prepare::StudyFields studyFields(const EngineSource &source) {
    return [source](const task::Progress &progress) {
        return fieldsOf(source, source.volume, progress);
    };
}

void makeEngine(const EngineSource &source, Detail first, const TakeEngine &take,
                const task::Progress &progress) {
    requireMemory(source);
    if (first == Detail::coarse && isLarge(source.volume))
        makeCoarseEngine(source, coarseSide, take, progress.part(0.0, 0.1));
    take(engineOf(source, source.volume, progress.part(0.1, 1.0)), Detail::full);
}

void makeCoarseEngine(const EngineSource &source, int side, const TakeEngine &take,
                      const task::Progress &progress) {
    prepare::PreparedEngine engine =
        engineOf(source, classify::coarseVolume(source.volume, side), progress);
    engine.isCoarse = true;
    take(engine, Detail::coarse);
}

void makeLayers(const EngineSource &source, const TakeLayers &take,
                const task::Progress &progress) {
    const auto mixture = classify::mixtureOf(source.wanted.look, source.wanted.adjustedClass);
    const classify::FieldWindow window = windowOf(source);
    preprocess::ClassRunner runner(*source.steps, source.segments);
    const auto make = [&](const volume::Volume &of, Detail detail, const task::Progress &part) {
        classify::LayerFields fields(of, window, mixture, &runner);
        take(prepare::LayerSet::prepare(
                 sceneOf(source.wanted), fields.count(),
                 [&](std::size_t n, const task::Progress &p) {
                     return classify::cropped(fields.field(n, p), source.wanted.crop);
                 },
                 // The engines of the sum need the other half.
                 {system::availableMemoryBytes() / 2}, part,
                 shading::shadingScale(source.volume.lattice())),
             detail);
    };
    // Weights can be dragged before the full layers are ready.
    if (isLarge(source.volume))
        make(classify::coarseVolume(source.volume, coarseSide), Detail::coarse,
             progress.part(0.0, 0.1));
    make(source.volume, Detail::full, progress.part(0.1, 1.0));
}

} // namespace pellucid::ui
