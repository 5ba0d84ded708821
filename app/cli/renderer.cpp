// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/cli/input.h"
#include "app/cli/json_text.h"
#include "core/plan/frame_model.h"
#include "core/reference/shaded_field.h"
#include "core/scene/planning_scene.h"
#include "core/task/error.h"
#include "gpu/surfaceless_context.h"

namespace pellucid::cli {

using nlohmann::json;

namespace {

constexpr const char *whyExact = "no engine keeps the tolerance: the exact reference does";

// The error for a user who requires the card: the card is too small, or we cannot use one.
task::Error cardRefused(const task::Error &error) {
    const bool isTooSmall = error.code() == task::ErrorCode::outOfMemory;
    return {isTooSmall ? error.code() : task::ErrorCode::noSuchDevice,
            task::because::inWords("--engine gpu: " + error.reason().english())};
}

prepare::ShadedFields shadedFor(const scene::Scene &scene, const classify::ShownFields &fields,
                                const task::Progress &progress) {
    return prepare::shadedFields(fields.channels, scene.shading,
                                 shading::shadingScale(fields.channels.front().values.lattice()),
                                 progress);
}

} // namespace

CardChoice chooseCard(const std::string &engine, int frames) {
    CardChoice choice{engine == "gpu", nullptr, "the graphics card was asked for"};
    if (engine == "cpu")
        choice.reason = "the processor was asked for";
    else if (engine == "auto" && frames < 2)
        choice.reason = "one image is made sooner than a graphics card has its spectra";
    else
        try {
            choice.passes = std::make_shared<gpu::FramePasses>(std::make_shared<gpu::Device>(
                std::make_unique<gpu::SurfacelessContext>(choice.isAsked)));
            if (!choice.isAsked)
                choice.reason = "there is a graphics card";
            if (!choice.isAsked && choice.passes->device().capabilities().software) {
                choice.reason = "OpenGL here is a software renderer";
                choice.passes.reset();
            }
        } catch (const task::Error &error) {
            if (choice.isAsked)
                throw cardRefused(error);
            choice.reason = error.reason().english();
        }
    return choice;
}

Renderer::Renderer(const scene::Scene &scene, const classify::ShownFields &fields,
                   const plan::Budget &budget, const Context &context)
    : Renderer(scene, fields, shadedFor(scene, fields, task::Progress(context.stop)), budget,
               context) {}

Renderer::Renderer(const scene::Scene &scene, const classify::ShownFields &fields,
                   const prepare::ShadedFields &shaded, const plan::Budget &budget,
                   const Context &context)
    : Renderer(scene, fields, shaded, prepare::summarise(shaded, scene.shading.cue), budget,
               context) {}

Renderer::Renderer(const scene::Scene &scene, const classify::ShownFields &fields,
                   const prepare::ShadedFields &shaded,
                   const std::vector<plan::FieldSummary> &summaries, const plan::Budget &budget,
                   const Context &context)
    : m_scene(scene), m_fields(fields), m_progress(context.stop),
      m_channels(std::size_t(prepare::imagesOf(fields.channels.size(), scene.shading))),
      m_isGrey(fields.isGrey() && m_channels == 1),
      m_fitting(
          prepare::planWithin(scene::planningScene(scene, shaded.fields.front().values.lattice()),
                              shaded, summaries, budget, m_progress)),
      m_lattice(shaded.fields.front().values.lattice()) {
    const plan::RenderPlan &plan = m_fitting.plan;
    std::size_t exactBytes = 0;
    for (std::size_t c = 0; c < m_channels; ++c)
        exactBytes += reference::WideKernel::bytes(summaries.front().support) +
                      reference::sliceBytes(m_lattice, scene.camera, scene.image);
    if (!scene.shading.isPlain()) // the enlarged field and its shaded copy
        exactBytes += 2 * m_lattice.size().count() * sizeof(float);
    if (plan.predictedError <= scene.tolerance || scene.interpolation != scene::Interpolation() ||
        scene.plannedFor == scene::PlannedFor::volume || m_fitting.reduction > 1 ||
        exactBytes > budget.bytes) {
        const prepare::ShadedFields &sources = m_fitting.reduced ? *m_fitting.reduced : shaded;
        m_lattice = sources.fields.front().values.lattice();
        m_engine = prepare::makeEngine(sources, fields.color, plan, m_progress);
        if (m_fitting.reduction == 1) // otherwise every view loses detail
            m_viewModel.emplace(plan, summaries);
        m_fitting.reduced.reset();
        m_bytes = plan.bytes;
        m_predictedError = plan.predictedError;
        return;
    }
    if (scene.shading.isPlain())
        for (const classify::DensityField &field : fields.channels)
            m_references.emplace_back(field.values, field.support, m_progress);
    m_bytes = exactBytes;
    // Two errors remain: rounding, about 1e-10 in double precision or that of a shaded field's
    // float samples, and the tails of the roll-off.
    const double rounding = m_references.empty() ? 6e-8 : 1e-10;
    for (const plan::FieldSummary &summary : summaries)
        m_predictedError = std::max(
            m_predictedError,
            std::hypot(rounding, reference::foldedTails(summary.lattice, scene.camera, scene.image,
                                                        *summary.energy.spread)));
}

void Renderer::use(const CardChoice &card) {
    m_choice = card;
    if (!m_engine)
        m_choice.reason = whyExact;
    if (!m_engine && card.isAsked)
        throw cardRefused({task::ErrorCode::noSuchDevice,
                           task::because::inWords(m_choice.reason + ", on the processor")});
    if (!m_engine || !card.passes)
        return;
    try {
        const gpu::FetchPlan plan =
            gpu::planFetch(m_fitting.plan, m_scene.tolerance, m_scene.shading);
        m_card = gpu::copyToCard(card.passes, *m_engine, plan.fetch, m_progress);
        m_predictedError = plan.predictedError;
    } catch (const task::Error &error) {
        if (card.isAsked)
            throw cardRefused(error);
        m_choice.reason = error.reason().english();
    }
}

picture::ProjectionImage Renderer::image(const scene::Camera &camera, picture::FrameTimes &times) {
    if (m_card) {
        try {
            auto image = m_card->render(camera, m_scene.image, m_scene.shading, &times);
            judge(image, camera);
            return image;
        } catch (const task::Error &error) {
            // The card was lost, or is too small for this image: the processor takes over, unless
            // the user requires the card.
            if (m_choice.isAsked)
                throw cardRefused(error);
            m_choice.reason = error.reason().english();
            m_card.reset();
            m_predictedError = m_fitting.plan.predictedError;
        }
    }
    if (m_engine) {
        auto image = m_engine->render(camera, m_scene.image, m_scene.shading, &times);
        judge(image, camera);
        return image;
    }
    Stopwatch watch;
    picture::ProjectionImage image = exactImage(camera);
    times = {watch.lapMs(), 0.0};
    return image;
}

void Renderer::judge(const picture::ProjectionImage &image, const scene::Camera &camera) {
    if (!m_viewModel)
        return;
    const render::EngineParts parts = m_engine->parts();
    // The card's own texture filter adds the same error to every view.
    const double bound = m_fitting.plan.predictedError,
                 added = std::max(0.0, m_predictedError * m_predictedError - bound * bound);
    m_picture = m_viewModel->errorOf(image, camera, m_scene.image, parts, m_scene.shading);
    m_picture->relative = std::hypot(m_picture->relative, std::sqrt(added));
}

picture::ProjectionImage Renderer::exactImage(const scene::Camera &camera) const {
    picture::ProjectionImage image{camera.width, camera.height, camera.pixelMm, {}};
    image.channels = m_isGrey ? 1 : 3;
    if (m_references.empty()) {
        const auto exact =
            reference::shadedImage(m_fields, m_scene.shading, camera, m_scene.image, m_progress);
        image.samples.assign(exact.begin(), exact.end());
        return image;
    }
    std::vector<std::vector<double>> planes;
    for (const reference::WideKernel &exact : m_references)
        planes.push_back(exact.image(camera, m_scene.image));
    if (m_isGrey) {
        image.samples.assign(planes.front().begin(), planes.front().end());
        return image;
    }
    image.samples.resize(3 * planes.front().size());
    const classify::Color &of = m_fields.color;
    const std::array<double, 3> color{of.red, of.green, of.blue};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<double> &plane = planes[std::min(c, planes.size() - 1)];
        for (std::size_t n = 0; n < plane.size(); ++n)
            image.samples[3 * n + c] = float((planes.size() == 1 ? color[c] : 1.0) * plane[n]);
    }
    return image;
}

std::string Renderer::description() const {
    if (m_card)
        return m_card->description().english();
    return m_engine ? m_engine->description().english() : "exact reference, double precision";
}

json Renderer::planJson() const {
    if (!m_engine)
        return {{"model",
                 {{"spectra", json::array()},
                  {"slices", 0},
                  {"images", m_channels},
                  {"combination", "each image is evaluated by itself, in double precision"},
                  {"multiply_adds", nullptr},
                  {"transform_operations", nullptr},
                  {"bytes", {{"spectra", m_bytes}, {"frame", nullptr}}},
                  {"left_out", json::array()}}},
                {"kernel", "KB12"},
                {"taps", 12 * 12 * 12},
                {"padding", 2.0},
                {"storage", "f64"},
                {"predicted_error", m_predictedError},
                {"reason", whyExact}};
    const plan::RenderPlan &plan = m_fitting.plan;
    const auto &s = plan.spectrum;
    const plan::SliceGrid grid =
        plan::sliceGrid(m_scene.camera, plan.room, m_lattice, m_scene.image);
    const int w = s.width();
    const auto fields = int(m_fields.channels.size());
    const plan::FrameModel model =
        plan::modelFrame(plan, m_scene,
                         {fields, fields > 1 ? plan::SpectrumOf::channel : plan::SpectrumOf::look,
                          !m_fields.isGrey()},
                         m_lattice);
    json spectra = json::array(), leftOut = json::array();
    for (const plan::FrameModel::Spectra &kind : model.spectra)
        spectra.push_back({{"of", plan::spectrumText(kind.of)},
                           {"count", kind.count},
                           {"because", plan::reasonText(kind.of)}});
    for (const plan::LeftOut what : model.leftOut)
        leftOut.push_back(plan::leftOutText(what));
    const json modelled = {
        {"spectra", spectra},
        {"slices", model.slices},
        {"images", model.images},
        {"combination", plan::combinationText(model.combination)},
        {"multiply_adds", std::llround(model.multiplyAdds)},
        {"transform_operations", std::llround(model.transformOperations)},
        {"bytes", {{"spectra", model.spectrumBytes}, {"frame", model.frameBytes}}},
        {"left_out", leftOut}};
    return {{"model", modelled},
            {"kernel", s.kernels[0].name()},
            {"taps", w * w * w},
            {"padded", sizeJson(s.padded)},
            {"box", sizeJson(s.box.size())},
            {"padding", double(s.padded.i) / s.box.size().i},
            {"slice_grid", {grid.columns, grid.rows}},
            {"storage", fourier::storageName(s.storage)},
            {"predicted_error", plan.predictedError},
            {"reason", plan.reason.english()}};
}

std::optional<double> Renderer::predictedMaximum() const {
    if (!m_engine || !wasWhole().value_or(false))
        return std::nullopt;
    return m_fitting.plan.predictedMaximum;
}

} // namespace pellucid::cli
