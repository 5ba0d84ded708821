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
    : m_scene(scene), m_color(fields.color), m_isGrey(fields.isGrey()) {
    const task::Progress progress(context.stop);
    std::size_t held = 0;
    for (const classify::DensityField &field : fields.channels) {
        m_channels.push_back(
            makeChannel(field, {budget.bytes - std::min(budget.bytes, held)}, progress));
        held += m_channels.back().bytes;
    }
}

Renderer::Channel Renderer::makeChannel(const classify::DensityField &field,
                                        const render::Budget &budget,
                                        const task::Progress &progress) const {
    const render::FieldSummary summary = render::summarise(field);
    Channel channel{render::planWithin(m_scene, field, summary, budget, progress),
                    field.values.lattice()};
    const render::RenderPlan &plan = channel.fitting.plan;
    const std::size_t exactBytes =
        reference::WideKernel::bytes(field.support) +
        reference::sliceBytes(field.values.lattice(), m_scene.camera, m_scene.image);
    if (plan.predictedError <= m_scene.tolerance ||
        m_scene.interpolation != render::Interpolation() || channel.fitting.reduction > 1 ||
        exactBytes > budget.bytes) {
        const auto &source = channel.fitting.reducedField ? *channel.fitting.reducedField : field;
        channel.engine = std::make_unique<render::CpuEngine>(
            std::make_shared<const fourier::Spectrum>(
                fourier::Spectrum::prepare(source.values, plan.spectrum, progress)),
            plan.room);
        channel.lattice = source.values.lattice();
        channel.bytes = plan.bytes;
        channel.predictedError = plan.predictedError;
        channel.fitting.reducedField.reset();
    } else {
        channel.reference =
            std::make_unique<reference::WideKernel>(field.values, field.support, progress);
        channel.bytes = exactBytes;
        // Double precision leaves rounding, about 1e-10, and what is left of the roll-off's tails.
        channel.predictedError =
            std::hypot(1e-10, reference::foldedTails(summary.lattice, m_scene.camera, m_scene.image,
                                                     *summary.energy.spread));
    }
    return channel;
}

std::vector<float> Renderer::project(Channel &channel, const render::Camera &camera,
                                     render::FrameTimes &times) const {
    if (channel.engine) {
        render::FrameTimes own;
        auto image = channel.engine->render(camera, m_scene.image, &own);
        times.sliceMs += own.sliceMs;
        times.transformMs += own.transformMs;
        return std::move(image.samples);
    }
    Stopwatch watch;
    const auto exact = channel.reference->image(camera, m_scene.image);
    times.sliceMs += watch.lapMs();
    return {exact.begin(), exact.end()};
}

render::ProjectionImage Renderer::image(const render::Camera &camera, render::FrameTimes &times) {
    times = {};
    std::vector<std::vector<float>> planes;
    for (Channel &channel : m_channels)
        planes.push_back(project(channel, camera, times));
    render::ProjectionImage image{camera.width, camera.height, camera.pixelMm, {}};
    if (m_isGrey) {
        image.samples = std::move(planes.front());
        return image;
    }
    image.channels = 3;
    image.samples.resize(3 * planes.front().size());
    const std::array<double, 3> color{m_color.red, m_color.green, m_color.blue};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<float> &plane = planes[std::min(c, planes.size() - 1)];
        const float factor = planes.size() == 1 ? float(color[c]) : 1.0F;
        for (std::size_t n = 0; n < plane.size(); ++n)
            image.samples[3 * n + c] = factor * plane[n];
    }
    return image;
}

std::string Renderer::description() const {
    const Channel &first = m_channels.front();
    return first.engine ? first.engine->description() : "exact reference, double precision";
}

json Renderer::planJson() const {
    const Channel &first = m_channels.front();
    if (!first.engine)
        return {{"kernel", "KB12"}, {"taps", 12 * 12 * 12}, {"padding", 2.0}, {"storage", "f64"}};
    const render::RenderPlan &plan = first.fitting.plan;
    const auto &s = plan.spectrum;
    const render::SliceGrid grid =
        render::sliceGrid(m_scene.camera, plan.room, first.lattice, m_scene.image);
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

std::size_t Renderer::bytes() const {
    std::size_t sum = 0;
    for (const Channel &channel : m_channels)
        sum += channel.bytes;
    return sum;
}

double Renderer::predictedError() const {
    double most = 0.0;
    for (const Channel &channel : m_channels)
        most = std::max(most, channel.predictedError);
    return most;
}

std::optional<double> Renderer::predictedMaximum() const {
    std::optional<double> most;
    for (const Channel &channel : m_channels)
        if (channel.engine)
            most = std::max(most.value_or(0.0), channel.fitting.plan.predictedMaximum);
    return most;
}

} // namespace pellucid::cli
