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
// Views that stand still, and weight changes at each.
constexpr int stillViews = 6, changes = 8;

scene::Camera truthCamera(const LookSubject &subject) {
    scene::Camera camera = subject.scene.camera;
    camera.orientation = randomViews(1, 11).front();
    return camera;
}

std::string noted(const std::string &note, const Row &row, double plainMs) {
    return note + (note.empty() ? "" : "; ") + ratioText(row, plainMs);
}

// The rows of one look, see `reportLook`.
class LookRows {
public:
    LookRows(const std::string &suite, const std::string &name, const LookSubject &subject,
             const classify::Look &look, const std::string &note)
        : m_suite(suite), m_name(name), m_subject(subject), m_look(look), m_note(note),
          m_fields(shownFields()), m_mixture(classify::mixtureOf(look)),
          m_exact(reference::shadedImage(m_fields, {}, truthCamera(subject), subject.scene.image)),
          m_plain(prepare::prepareEngine(
              {subject.scene,
               classify::ShownFields{{classify::densityField(subject.volume, subject.window)},
                                     {}}})) {}

    void report(const Report &report) const {
        report(settled());
        const double start = millisecondsNow();
        const auto layers = prepare::LayerSet::prepare(
            m_subject.scene, m_mixture.layers.size(),
            [&](std::size_t n, const task::Progress &progress) {
                return classify::layerField(m_subject.volume, m_subject.window, m_mixture.layers[n],
                                            nullptr, progress);
            },
            {});
        Row row = plannedRow(m_suite, m_name, m_subject.volume.lattice().size(), layers->plan(),
                             m_subject.scene, 0);
        row.prepareMs = millisecondsNow() - start;
        row.bytes = double(layers->bytes());
        report(bothMove(row, layers));
        report(weightsMove(row, *layers));
    }

private:
    classify::ShownFields shownFields() const {
        return classify::shownFields(m_subject.volume, m_subject.window, m_look, nullptr);
    }

    Row settled() const {
        const double start = millisecondsNow();
        // Includes the fields, which a change of a range recomputes.
        const auto prepared = prepare::prepareEngine({m_subject.scene, shownFields()});
        Row row = plannedRow(m_suite, m_name + ", settled", m_subject.volume.lattice().size(),
                             prepared.plan, m_subject.scene, 0);
        row.prepareMs = millisecondsNow() - start;
        row.bytes = double(m_fields.channels.size()) * double(prepared.plan.spectrum.bytes());
        measureEngine(row, *prepared.engine);
        return row;
    }

    Row bothMove(Row row, const std::shared_ptr<prepare::LayerSet> &layers) const {
        row.name = m_name + ", both move";
        prepare::MixtureEngine engine(layers, m_mixture.channelWeights);
        measureEngine(row, engine);
        return row;
    }

    Row weightsMove(Row row, prepare::LayerSet &layers) const {
        row.name = m_name + ", weights move";
        std::vector<double> first, later;
        scene::Camera camera = m_subject.scene.camera;
        auto channelWeights = m_mixture.channelWeights;
        const auto render = [&] {
            return layers.render(camera, m_subject.scene.image, {}, channelWeights);
        };
        for (const glm::dquat &orientation : randomViews(stillViews)) {
            camera.orientation = orientation;
            render();
            for (int change = 0; change < changes; ++change) {
                for (double &share : channelWeights[std::size_t(change) % channelWeights.size()])
                    share *= 0.98;
                const double start = millisecondsNow();
                render();
                (change == 0 ? first : later).push_back(millisecondsNow() - start);
            }
        }
        camera = truthCamera(m_subject);
        channelWeights = m_mixture.channelWeights;
        render();
        fillError(row, compare(render().samples, m_exact));
        row.frameMs = median(later);
        row.note = fmt::format("{}{}the first change at a view {:.1f} ms", m_note,
                               m_note.empty() ? "" : "; ", median(first));
        return row;
    }

    void measureEngine(Row &row, render::ProjectionEngine &engine) const {
        const double plainMs =
            fillTimesInTurns(row, engine, *m_plain.engine, m_subject.scene, views);
        fillError(row, compare(engine.render(truthCamera(m_subject), m_subject.scene.image).samples,
                               m_exact));
        row.note = noted(m_note, row, plainMs);
    }

    const std::string &m_suite, &m_name;
    const LookSubject &m_subject;
    const classify::Look &m_look;
    const std::string &m_note;
    classify::ShownFields m_fields;
    classify::Mixture m_mixture;
    std::vector<double> m_exact;
    prepare::PreparedEngine m_plain;
};

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
    LookRows(suite, name, subject, look, note).report(report);
}

classify::Look boneAndSoftTissue() {
    classify::Look look;
    look.classes = {{.name = "Bone", .low = 200.0, .high = 3071.0, .color = {1.0, 0.9, 0.7}},
                    {.name = "Soft", .low = -200.0, .high = 150.0, .color = {0.2, 0.5, 0.7}}};
    return look;
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
    ShadedFrames frames{{}, prepare::prepareEngine({scene, fields})};
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
