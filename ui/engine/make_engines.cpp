// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/make_engines.h"

#include <algorithm>
#include <optional>

#include "core/classify/coarse_field.h"
#include "core/classify/layers.h"
#include "core/classify/shown_fields.h"
#include "core/scene/planning_scene.h"
#include "core/system/memory.h"
#include "core/task/error.h"

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
scene::Scene planningScene(const volume::Volume &volume, const prepare::PreparedFor &wanted) {
    scene::Scene scene;
    scene.plannedFor = scene::PlannedFor::volume;
    scene.tolerance = wanted.tolerance;
    scene.interpolation = wanted.interpolation;
    scene.image = wanted.image;
    scene.shading.cue = wanted.cue;
    if (wanted.isLit)
        scene.shading.lights.emplace_back();
    return scene::planningScene(scene, volume.lattice());
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

class EngineMaker {
public:
    EngineMaker(const EngineSource &source, const TakeEngine &take, const task::Progress &progress)
        : m_source(source), m_take(take), m_progress(progress),
          m_scene(planningScene(source.volume, source.wanted)),
          m_scale(shading::shadingScale(source.volume.lattice())) {}

    void make(Detail first) {
        requireMemory();
        if (first == Detail::coarse && isLarge(m_source.volume))
            makeCoarse(coarseSide);
        take(fieldsOf(m_source, m_source.volume, m_progress.part(0.1, 0.3)), Detail::full,
             m_progress.part(0.3, 1.0));
    }

    // The steps of classes take no time on a small volume.
    void makeCoarse(int side) {
        take(fieldsOf(m_source, classify::coarseVolume(m_source.volume, side), {}), Detail::coarse,
             m_progress.part(0.0, 0.1));
    }

private:
    void requireMemory() const {
        const volume::GridSize size = m_source.volume.lattice().size();
        const classify::Look &look = m_source.wanted.look;
        const std::size_t needed =
            classify::peakBytes(look, size.count()) +
            prepare::bytesForLight(m_scene.shading, size, classify::channelsOf(look));
        if (needed > system::availableMemoryBytes())
            throw task::Error(task::ErrorCode::outOfMemory,
                              task::because::fieldsNeedMemory(needed >> 20));
    }

    void take(classify::ShownFields fields, Detail detail, const task::Progress &progress) {
        prepare::PreparedEngine engine = prepare::prepareEngine(
            m_scene, std::move(fields), {system::availableMemoryBytes()}, progress, m_scale);
        engine.isCoarse = detail == Detail::coarse;
        engine.study = studyFields(m_source);
        m_take(engine, detail);
    }

    const EngineSource &m_source;
    const TakeEngine &m_take;
    const task::Progress m_progress;
    const scene::Scene m_scene;
    const shading::ShadingScale m_scale;
};

} // namespace

prepare::StudyFields studyFields(const EngineSource &source) {
    return [source](const task::Progress &progress) {
        return fieldsOf(source, source.volume, progress);
    };
}

void makeEngine(const EngineSource &source, Detail first, const TakeEngine &take,
                const task::Progress &progress) {
    EngineMaker(source, take, progress).make(first);
}

void makeCoarseEngine(const EngineSource &source, int side, const TakeEngine &take,
                      const task::Progress &progress) {
    EngineMaker(source, take, progress).makeCoarse(side);
}

void makeLayers(const EngineSource &source, const TakeLayers &take,
                const task::Progress &progress) {
    const auto mixture = classify::mixtureOf(source.wanted.look, source.wanted.adjustedClass);
    const classify::FieldWindow window = windowOf(source);
    preprocess::ClassRunner runner(*source.steps, source.segments);
    const auto make = [&](const volume::Volume &of, Detail detail, const task::Progress &part) {
        classify::LayerFields fields(of, window, mixture, &runner);
        take(prepare::LayerSet::prepare(
                 planningScene(of, source.wanted), fields.count(),
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
