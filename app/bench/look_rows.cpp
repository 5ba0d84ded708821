// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/bench/look_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/classify/layers.h"
#include "core/classify/shown_fields.h"
#include "core/prepare/layer_set.h"
#include "core/reference/shaded_field.h"

namespace pellucid::bench {

namespace {

constexpr int views = 48;
// Weight changes at each of the views that stand still.
constexpr int stillViews = 6, changes = 8;

scene::Camera truthCamera(const LookSubject &subject) {
    scene::Camera camera = subject.scene.camera;
    camera.orientation = randomViews(1, 11).front();
    return camera;
}

std::string noted(const std::string &note, const Row &row, double plainMs) {
    return note + (note.empty() ? "" : "; ") + ratioText(row, plainMs);
}

} // namespace

LookSubject::LookSubject(int side)
    : volume(phantom::makePhantom(
          phantom::Kind::head,
          phantom::phantomLattice(phantom::Kind::head,
                                  {.size = volume::GridSize{side, side, side}}))),
      window(classify::defaultFieldWindow(volume)) {
    scene.camera = squareCamera(volume.lattice(), side);
}

void reportLook(const Report &report, const std::string &suite, const std::string &name,
                const LookSubject &subject, const classify::Look &look, const std::string &note) {
    const auto fields = classify::shownFields(subject.volume, subject.window, look, nullptr);
    const std::vector<double> exact =
        reference::shadedImage(fields, {}, truthCamera(subject), subject.scene.image);
    const auto mixture = classify::mixtureOf(look);
    const auto plain = prepare::prepareEngine(
        subject.scene, {{classify::densityField(subject.volume, subject.window)}, {}}, {});
    {
        double start = millisecondsNow();
        // The fields are part of what a change of a range costs.
        const auto prepared = prepare::prepareEngine(
            subject.scene, classify::shownFields(subject.volume, subject.window, look, nullptr),
            {});
        Row row = plannedRow(suite, name + ", settled", subject.volume.lattice().size(),
                             prepared.plan, subject.scene, 0);
        row.prepareMs = millisecondsNow() - start;
        row.bytes = double(fields.channels.size()) * double(prepared.plan.spectrum.bytes());
        const double plainMs =
            fillTimesInTurns(row, *prepared.engine, *plain.engine, subject.scene, views);
        fillError(
            row, compare(prepared.engine->render(truthCamera(subject), subject.scene.image).samples,
                         exact));
        row.note = noted(note, row, plainMs);
        report(row);
    }
    double start = millisecondsNow();
    const auto layers = prepare::LayerSet::prepare(
        subject.scene, mixture.layers.size(),
        [&](std::size_t n, const task::Progress &progress) {
            return classify::layerField(subject.volume, subject.window, mixture.layers[n], nullptr,
                                        progress);
        },
        {});
    Row summed = plannedRow(suite, name + ", both move", subject.volume.lattice().size(),
                            layers->plan(), subject.scene, 0);
    summed.prepareMs = millisecondsNow() - start;
    summed.bytes = double(layers->bytes());
    if (const auto &loss = layers->detailLoss())
        summed.predictedError =
            std::hypot(*summed.predictedError, loss->relativeError(mixture.shares, {}));
    Row kept = summed;
    kept.name = name + ", weights move";
    prepare::MixtureEngine engine(layers, mixture.shares);
    const double plainMs = fillTimesInTurns(summed, engine, *plain.engine, subject.scene, views);
    fillError(summed,
              compare(engine.render(truthCamera(subject), subject.scene.image).samples, exact));
    summed.note = noted(note, summed, plainMs);
    report(summed);

    std::vector<double> first, later;
    scene::Camera camera = subject.scene.camera;
    auto shares = mixture.shares;
    for (const glm::dquat &orientation : randomViews(stillViews)) {
        camera.orientation = orientation;
        layers->render(camera, subject.scene.image, {}, shares);
        for (int change = 0; change < changes; ++change) {
            for (double &share : shares[std::size_t(change) % shares.size()])
                share *= 0.98;
            start = millisecondsNow();
            layers->render(camera, subject.scene.image, {}, shares);
            (change == 0 ? first : later).push_back(millisecondsNow() - start);
        }
    }
    layers->render(truthCamera(subject), subject.scene.image, {}, mixture.shares);
    fillError(
        kept,
        compare(
            layers->render(truthCamera(subject), subject.scene.image, {}, mixture.shares).samples,
            exact));
    kept.frameMs = median(later);
    kept.note = fmt::format("{}{}the first change at a view {:.1f} ms", note,
                            note.empty() ? "" : "; ", median(first));
    report(kept);
}

std::vector<shading::Light> threeLights(bool colored) {
    std::vector<shading::Light> lights{{{1, 0, 0}}, {{-0.5, 0.866, 0}}, {{-0.5, -0.866, 0}}};
    if (colored) {
        lights[0].color = {1, 0, 0};
        lights[1].color = {0, 1, 0};
        lights[2].color = {0, 0, 1};
    }
    return lights;
}

ShadedFrames measureShaded(const std::string &suite, const std::string &name,
                           const classify::ShownFields &fields, const scene::Scene &scene,
                           render::ProjectionEngine &plain) {
    const double start = millisecondsNow();
    ShadedFrames frames{{}, prepare::prepareEngine(scene, fields, {})};
    const double prepareMs = millisecondsNow() - start;
    render::ProjectionEngine &engine = *frames.prepared.engine;
    Row row = plannedRow(suite, name, fields.channels.front().values.lattice().size(),
                         frames.prepared.plan, scene, 0);
    row.prepareMs = prepareMs;
    row.bytes = double(frames.prepared.bytes);
    const double plainMs = fillTimesInTurns(row, engine, plain, scene, views);
    row.note = ratioText(row, plainMs);
    scene::Camera camera = scene.camera;
    camera.orientation = randomViews(1, 11).front();
    fillError(row, compare(engine.render(camera, scene.image, scene.shading).samples,
                           reference::shadedImage(fields, scene.shading, camera, scene.image)));
    frames.row = row;
    return frames;
}

} // namespace pellucid::bench
