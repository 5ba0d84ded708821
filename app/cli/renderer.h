// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/cli/commands.h"
#include "core/classify/shown_fields.h"
#include "core/reference/wide_kernel.h"
#include "core/render/prepared_engine.h"

namespace pellucid::cli {

/// Images of one scene within a tolerance: each channel by the engine, or by the exact reference
/// where no plan keeps the tolerance, unless the memory is short or the scene fixes the
/// interpolation.
class Renderer {
public:
    /// The scene must outlive it. *Throws* Error{outOfMemory}, Cancelled.
    Renderer(const render::Scene &scene, const classify::ShownFields &fields,
             const render::Budget &budget, const Context &context);

    /// `times`: of this image, all channels.
    render::ProjectionImage image(const render::Camera &camera, render::FrameTimes &times);

    /// What makes the images, one line.
    std::string description() const;
    /// Of the first channel.
    nlohmann::json planJson() const;
    std::size_t channelCount() const { return m_channels.size(); }
    std::size_t bytes() const;
    bool isReduced() const { return m_channels.front().fitting.reduction > 1; }
    const std::string &reason() const { return m_channels.front().fitting.plan.reason; }
    /// The worst channel's: the picture's, all channels taken together, is no larger.
    double predictedError() const;
    /// Of the engine only: the reference's lies below what a float image holds.
    std::optional<double> predictedMaximum() const;

private:
    struct Channel {
        render::FittingPlan fitting;
        volume::Lattice lattice; ///< of what the engine renders
        std::size_t bytes = 0;
        double predictedError = 0.0;
        std::unique_ptr<render::CpuEngine> engine;
        std::unique_ptr<reference::WideKernel> reference;
    };
    Channel makeChannel(const classify::DensityField &field, const render::Budget &budget,
                        const task::Progress &progress) const;
    std::vector<float> project(Channel &channel, const render::Camera &camera,
                               render::FrameTimes &times) const;

    const render::Scene &m_scene;
    classify::Color m_color;
    bool m_isGrey;
    std::vector<Channel> m_channels;
};

} // namespace pellucid::cli
