// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/cli/input.h"
#include "app/cli/json_text.h"

namespace pellucid::cli {

using nlohmann::json;

Renderer::Renderer(const render::Scene &scene, const classify::ShownFields &fields,
                   const render::Budget &budget, const Context &context)
    : Renderer(scene, fields, render::summarise(fields.channels), budget, context) {}

Renderer::Renderer(const render::Scene &scene, const classify::ShownFields &fields,
                   const std::vector<render::FieldSummary> &summaries, const render::Budget &budget,
                   const Context &context)
    : m_scene(scene), m_color(fields.color), m_channels(fields.channels.size()),
      m_isGrey(fields.isGrey()),
      m_fitting(render::planWithin(scene, fields.channels, summaries, budget,
                                   task::Progress(context.stop))),
      m_lattice(fields.channels.front().values.lattice()) {
    const task::Progress progress(context.stop);
    const render::RenderPlan &plan = m_fitting.plan;
    std::size_t exactBytes = 0;
    for (const classify::DensityField &field : fields.channels)
        exactBytes += reference::WideKernel::bytes(field.support) +
                      reference::sliceBytes(m_lattice, scene.camera, scene.image);
    if (plan.predictedError <= scene.tolerance || scene.interpolation != render::Interpolation() ||
        m_fitting.reduction > 1 || exactBytes > budget.bytes) {
        const auto &sources =
            m_fitting.reducedFields.empty() ? fields.channels : m_fitting.reducedFields;
        m_lattice = sources.front().values.lattice();
        m_engine = render::makeEngine(sources, fields.color, plan, progress);
        m_fitting.reducedFields.clear();
        m_bytes = plan.bytes;
        m_predictedError = plan.predictedError;
        return;
    }
    for (const classify::DensityField &field : fields.channels)
        m_references.emplace_back(field.values, field.support, progress);
    m_bytes = exactBytes;
    // Double precision leaves rounding, about 1e-10, and what is left of the roll-off's tails.
    for (const render::FieldSummary &summary : summaries)
        m_predictedError = std::max(
            m_predictedError,
            std::hypot(1e-10, reference::foldedTails(summary.lattice, scene.camera, scene.image,
                                                     *summary.energy.spread)));
}

render::ProjectionImage Renderer::image(const render::Camera &camera, render::FrameTimes &times) {
    if (m_engine)
        return m_engine->render(camera, m_scene.image, &times);
    Stopwatch watch;
    std::vector<std::vector<double>> planes;
    for (const reference::WideKernel &exact : m_references)
        planes.push_back(exact.image(camera, m_scene.image));
    times = {watch.lapMs(), 0.0};
    render::ProjectionImage image{camera.width, camera.height, camera.pixelMm, {}};
    if (m_isGrey) {
        image.samples.assign(planes.front().begin(), planes.front().end());
        return image;
    }
    image.channels = 3;
    image.samples.resize(3 * planes.front().size());
    const std::array<double, 3> color{m_color.red, m_color.green, m_color.blue};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<double> &plane = planes[std::min(c, planes.size() - 1)];
        for (std::size_t n = 0; n < plane.size(); ++n)
            image.samples[3 * n + c] = float((planes.size() == 1 ? color[c] : 1.0) * plane[n]);
    }
    return image;
}

std::string Renderer::description() const {
    return m_engine ? m_engine->description() : "exact reference, double precision";
}

json Renderer::planJson() const {
    if (!m_engine)
        return {{"kernel", "KB12"}, {"taps", 12 * 12 * 12}, {"padding", 2.0}, {"storage", "f64"}};
    const render::RenderPlan &plan = m_fitting.plan;
    const auto &s = plan.spectrum;
    const render::SliceGrid grid =
        render::sliceGrid(m_scene.camera, plan.room, m_lattice, m_scene.image);
    const int w = s.width();
    return {{"kernel", s.kernels[0].name()},
            {"taps", w * w * w},
            {"padded", sizeJson(s.padded)},
            {"box", sizeJson(s.box.size())},
            {"padding", double(s.padded.i) / s.box.size().i},
            {"slice_grid", {grid.columns, grid.rows}},
            {"storage", fourier::storageName(s.storage)},
            {"reason", plan.reason}};
}

std::optional<double> Renderer::predictedMaximum() const {
    return m_engine ? std::optional(m_fitting.plan.predictedMaximum) : std::nullopt;
}

} // namespace pellucid::cli
