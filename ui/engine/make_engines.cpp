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

accuracy::AxisProjections projectionsOf(const prepare::ShadedFields &shaded,
                                        const task::Progress &progress) {
    accuracy::AxisProjections projections;
    for (const auto *const fields : {&shaded.fields, &shaded.gradients})
        for (const classify::DensityField &field : *fields)
            projections.add(field, progress);
    return projections;
}

classify::FieldWindow windowOf(const EngineSource &source) {
    return source.wanted.window.value_or(classify::defaultFieldWindow(source.volume));
}

class EngineMaker {
public:
    EngineMaker(const EngineSource &source, const TakeEngine &take, const task::Progress &progress)
        : m_source(source), m_take(take), m_progress(progress),
          m_scene(planningScene(source.volume, source.wanted)), m_window(windowOf(source)),
          m_scale(shading::shadingScale(source.volume.lattice())),
          m_runner(*source.steps, source.segments) {}

    void make(Detail first) {
        requireMemory();
        if (first == Detail::coarse && isLarge(m_source.volume))
            makeCoarse(coarseSide);
        auto fields = fieldsOf(m_source.volume, m_progress.part(0.1, 0.3));
        const plan::Budget budget = budgetFor(fields);
        auto shaded = prepare::shadedFields(std::move(fields), m_scene.shading, m_scale,
                                            m_progress.part(0.3, 0.35));
        if (m_coarse)
            addErrorOfCoarse(shaded);
        m_take(
            prepare::prepareEngine(m_scene, std::move(shaded), budget, m_progress.part(0.35, 1.0)),
            Detail::full);
    }

    // The steps of classes take no time on a small volume.
    void makeCoarse(int side) {
        const auto fields = fieldsOf(classify::coarseVolume(m_source.volume, side), {});
        const auto shaded = prepare::shadedFields(fields, m_scene.shading, m_scale);
        m_coarse =
            prepare::prepareEngine(m_scene, shaded, budgetFor(fields), m_progress.part(0.0, 0.1));
        m_coarse->isCoarse = true;
        m_take(*m_coarse, Detail::coarse);
        m_coarseProjections = projectionsOf(shaded, m_progress);
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

    classify::ShownFields fieldsOf(const volume::Volume &volume, const task::Progress &progress) {
        return classify::cropped(
            classify::shownFields(volume, m_window, m_source.wanted.look, &m_runner, progress),
            m_source.wanted.crop);
    }

    plan::Budget budgetFor(const classify::ShownFields &fields) const {
        const std::size_t free = system::availableMemoryBytes(),
                          light = prepare::bytesForLight(
                              m_scene.shading, fields.channels.front().values.lattice().size(),
                              fields.channels.size());
        return {free > light ? free - light : 0};
    }

    // Meanwhile the coarse picture is on the screen.
    void addErrorOfCoarse(const prepare::ShadedFields &shaded) {
        m_coarse->detailLoss = std::make_shared<const accuracy::DetailLoss>(
            projectionsOf(shaded, m_progress), m_coarseProjections, shaded.fields.size(),
            m_scale.stepMm);
        m_take(*m_coarse, Detail::coarse);
    }

    const EngineSource &m_source;
    const TakeEngine &m_take;
    const task::Progress m_progress;
    const scene::Scene m_scene;
    const classify::FieldWindow m_window;
    const shading::ShadingScale m_scale;
    preprocess::ClassRunner m_runner;
    std::optional<prepare::PreparedEngine> m_coarse;
    accuracy::AxisProjections m_coarseProjections;
};

} // namespace

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
