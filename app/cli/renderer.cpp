// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/renderer.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/cli/input.h"
#include "app/cli/json_text.h"

namespace pellucid::cli {

using nlohmann::json;

Renderer::Renderer(const render::Scene &scene, const classify::DensityField &field,
                   const render::Budget &budget, const Context &context)
    : m_scene(scene), m_summary(render::summarise(field)),
      m_fitting(render::planWithin(scene, field, m_summary, budget, task::Progress(context.stop))),
      m_lattice(field.values.lattice()) {
    const task::Progress progress(context.stop);
    const render::RenderPlan &plan = m_fitting.plan;
    const std::size_t exactBytes =
        reference::WideKernel::bytes(field.support) +
        reference::sliceBytes(field.values.lattice(), scene.camera, scene.image);
    const bool engine = plan.predictedError <= scene.tolerance ||
                        scene.interpolation != render::Interpolation() || isReduced() ||
                        exactBytes > budget.bytes;
    if (engine) {
        const auto &source = m_fitting.reducedField ? *m_fitting.reducedField : field;
        m_engine = std::make_unique<render::CpuEngine>(
            std::make_shared<const fourier::Spectrum>(
                fourier::Spectrum::prepare(source.values, plan.spectrum, progress)),
            plan.room);
        m_lattice = source.values.lattice();
        m_bytes = plan.bytes;
        m_fitting.reducedField.reset();
    } else {
        m_reference =
            std::make_unique<reference::WideKernel>(field.values, field.support, progress);
        m_bytes = exactBytes;
    }
}

render::ProjectionImage Renderer::image(const render::Camera &camera, render::FrameTimes &times) {
    if (m_engine)
        return m_engine->render(camera, m_scene.image, &times);
    Stopwatch watch;
    const auto exact = m_reference->image(camera, m_scene.image);
    times = {watch.lapMs(), 0.0};
    return {camera.width, camera.height, camera.pixelMm,
            std::vector<float>(exact.begin(), exact.end())};
}

std::string Renderer::description() const {
    return m_engine ? m_engine->description() : "exact reference, double precision";
}

json Renderer::planJson() const {
    if (!m_engine)
        return {{"kernel", "KB12"}, {"taps", 12 * 12 * 12}, {"padding", 2.0}, {"storage", "f64"}};
    const auto &s = m_fitting.plan.spectrum;
    const render::SliceGrid grid =
        render::sliceGrid(m_scene.camera, m_fitting.plan.room, m_lattice, m_scene.image);
    const int w = s.width();
    return {{"kernel", s.kernels[0].name()},
            {"taps", w * w * w},
            {"padded", sizeJson(s.padded)},
            {"box", sizeJson(s.box.size())},
            {"padding", double(s.padded.i) / s.box.size().i},
            {"slice_grid", {grid.columns, grid.rows}},
            {"storage", fourier::storageName(s.storage)},
            {"reason", m_fitting.plan.reason}};
}

double Renderer::predictedError() const {
    if (m_engine)
        return m_fitting.plan.predictedError;
    // Double precision leaves rounding, about 1e-10, and what is left of the roll-off's tails.
    return std::hypot(1e-10, reference::foldedTails(m_summary.lattice, m_scene.camera,
                                                    m_scene.image, *m_summary.energy.spread));
}

std::optional<double> Renderer::predictedMaximum() const {
    return m_engine ? std::optional(m_fitting.plan.predictedMaximum) : std::nullopt;
}

} // namespace pellucid::cli
