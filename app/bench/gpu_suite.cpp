// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <optional>

#include <fmt/format.h>

#include "app/bench/card_ray_sum.h"
#include "app/bench/suites.h"
#include "core/prepare/prepared_engine.h"
#include "core/reference/shaded_field.h"
#include "gpu/gpu_engine.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::bench {

namespace {

constexpr int views = 64, softwareViews = 8;

struct Timed {
    std::vector<double> slice, transform, card, submit, wall;
    int dispatches = 0;
};

// Times frames from random views; the pictures stay on the card. The first two compile and warm up.
Timed timeFrames(gpu::GpuEngine &engine, const scene::Scene &scene, int count) {
    Timed timed;
    scene::Camera camera = scene.camera;
    int frame = -2;
    for (const glm::dquat &orientation : randomViews(count + 2)) {
        camera.orientation = orientation;
        gpu::CardTimes times;
        const double start = millisecondsNow();
        engine.renderOnCard(camera, scene.image, scene.shading, &times);
        const double wall = millisecondsNow() - start;
        if (frame++ < 0)
            continue;
        timed.slice.push_back(times.sliceMs);
        timed.transform.push_back(times.transformMs);
        timed.card.push_back(times.sliceMs + times.transformMs);
        timed.submit.push_back(times.submitMs);
        timed.wall.push_back(wall);
        timed.dispatches = times.dispatches;
    }
    return timed;
}

// A frame of one pixel: the cost of submitting and waiting alone.
Timed timeOnePixel(gpu::GpuEngine &engine, const scene::Scene &scene, int count) {
    scene::Scene onePixel = scene;
    onePixel.camera.pixelMm *= 64.0;
    onePixel.camera.width = onePixel.camera.height = 1;
    return timeFrames(engine, onePixel, count);
}

struct Case {
    std::string name;
    double tolerance;
    std::optional<fourier::Storage> storage;
    shading::Shading shading;
};

class Size {
public:
    Size(const Report &report, const std::shared_ptr<gpu::FramePasses> &card, int side)
        : m_report(report), m_card(card),
          m_subject(phantomSubject(fmt::format("head {}", side), phantom::Kind::head,
                                   {.size = volume::GridSize{side, side, side}})),
          m_camera(squareCamera(m_subject.field.values.lattice(), side)),
          m_truth(m_subject, m_camera, side > 256 ? 1 : 2),
          m_views(card->device().capabilities().software ? softwareViews : views) {
        castRays();
    }

    void measureCase(const Case &of) {
        const classify::ShownFields fields{{m_subject.field}, {}};
        scene::Scene scene{.camera = m_camera, .shading = of.shading, .tolerance = of.tolerance};
        scene.interpolation.storage = of.storage;
        const auto prepared = prepare::prepareEngine({scene, fields});
        Row row = plannedRow("gpu", of.name + " " + m_subject.name,
                             m_subject.field.values.lattice().size(), prepared.plan, scene, 0);
        fillTimes(row, *prepared.engine, scene, m_views);
        const double processorMs = *row.frameMs;
        Row onProcessor = row;
        onProcessor.name += ", processor";
        const std::vector<std::vector<double>> truths = truthsOf(fields, scene);
        fillError(onProcessor, worstError(*prepared.engine, scene, truths));
        m_report(onProcessor);

        const double start = millisecondsNow();
        const auto engine = gpu::copyToCard(m_card, *prepared.engine);
        const double uploadMs = millisecondsNow() - start;
        const Timed timed = timeFrames(*engine, scene, m_views);
        const Timed onePixel = timeOnePixel(*engine, scene, m_views);
        Row onCard = row;
        // Rows of different cards must be distinguishable.
        onCard.engine = "gpu, " + m_card->device().capabilities().renderer;
        onCard.name += ", card";
        onCard.prepareMs = uploadMs;
        onCard.sliceMs = median(timed.slice);
        onCard.transformMs = median(timed.transform);
        onCard.frameMs = median(timed.card);
        onCard.bytes = double(engine->textures().bytes());
        onCard.submitMs = median(timed.submit);
        onCard.leastFrameMs = median(onePixel.card);
        onCard.raySumMs = m_rayMs;
        onCard.raySumRelativeL2 = m_rayError;
        fillError(onCard, worstError(*engine, scene, truths));
        onCard.note = fmt::format(
            "{:.1f} us in {} dispatches; dispatch floor (a frame of one pixel) {:.1f} us; "
            "submitted in {:.1f} us, done after {:.1f} us; copied in {:.0f} ms; the card's "
            "ray sum takes {:.1f} times as long, the processor {:.2f} times",
            1e3 * *onCard.frameMs, timed.dispatches, 1e3 * median(onePixel.card),
            1e3 * median(timed.submit), 1e3 * median(timed.wall), uploadMs,
            m_rayMs / *onCard.frameMs, processorMs / *onCard.frameMs);
        m_report(onCard);
    }

private:
    void castRays() {
        CardRaySum rays(m_card, m_subject.field.values);
        const double step = m_subject.field.values.lattice().shortestStepMm();
        std::vector<double> cast;
        scene::Camera camera = m_camera;
        for (const glm::dquat &orientation : randomViews(m_views)) {
            camera.orientation = orientation;
            cast.push_back(rays.render(camera, step).cardMs);
        }
        m_rayMs = median(cast);
        for (int view = 0; view < m_truth.views(); ++view)
            m_rayError = std::max(
                m_rayError, compare(rays.render(m_truth.camera(view), step).samples,
                                    m_truth.image(view, {scene::Reconstruction::linear, 0.05}))
                                .relativeL2);
    }

    // The exact images of all views; of one view for a shaded field, which differs in every view.
    std::vector<std::vector<double>> truthsOf(const classify::ShownFields &fields,
                                              const scene::Scene &scene) {
        if (!scene.shading.isPlain())
            return {reference::shadedImage(fields, scene.shading, m_truth.camera(0), scene.image)};
        std::vector<std::vector<double>> truths;
        for (int view = 0; view < m_truth.views(); ++view)
            truths.push_back(m_truth.image(view, scene.image));
        return truths;
    }

    ImageError worstError(render::ProjectionEngine &engine, const scene::Scene &scene,
                          const std::vector<std::vector<double>> &truths) {
        ImageError worst{0.0, 0.0, 1e9};
        for (std::size_t view = 0; view < truths.size(); ++view) {
            const auto image = engine.render(m_truth.camera(int(view)), scene.image, scene.shading);
            const ImageError error = compare(image.samples, truths[view]);
            worst = {std::max(worst.relativeL2, error.relativeL2),
                     std::max(worst.maximum, error.maximum), std::min(worst.psnrDb, error.psnrDb)};
        }
        return worst;
    }

    const Report &m_report;
    std::shared_ptr<gpu::FramePasses> m_card;
    Subject m_subject;
    scene::Camera m_camera;
    Truth m_truth;
    int m_views;
    double m_rayMs = 0.0, m_rayError = 0.0;
};

} // namespace

void runGpuSuite(const Report &report) {
    const auto card = std::make_shared<gpu::FramePasses>(
        std::make_shared<gpu::Device>(std::make_unique<gpu::SurfacelessContext>()));
    const gpu::Capabilities &capabilities = card->device().capabilities();
    std::printf(
        "card: %s, OpenGL %d.%d%s\n"
        "goals for the default quality: 50 us at 256^3, 100 us at 512^3, an eighth of the "
        "card's ray sum at 512^3\n",
        capabilities.renderer.c_str(), capabilities.version / 10, capabilities.version % 10,
        capabilities.software
            ? "; a software renderer: not representative of a graphics card, 512^3 is skipped"
            : "");
    const shading::DepthCue cue{shading::CueKind::linear, 1.0};
    const std::vector<shading::Light> light{{{1, 1, 0.7}}};
    const std::vector<Case> cases{{"default", 1.1e-3, {}, {}},
                                  {"interactive", 1e-2, {}, {}},
                                  {"float32", 1.1e-3, fourier::Storage::float32, {}},
                                  {"linear cue", 1.1e-3, {}, {.cue = cue}},
                                  {"light", 1.1e-3, {}, {.ambient = 0.3, .lights = light}}};
    for (const int side : {128, 256, 512}) {
        if (capabilities.software && side > 256)
            break;
        Size size(report, card, side);
        for (const Case &of : cases) // the exact image of a shaded 512^3 does not fit in memory
            if (side <= 256 || of.shading.isPlain())
                size.measureCase(of);
    }
}

} // namespace pellucid::bench
