// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/cli/commands.h"
#include "core/reference/wide_kernel.h"
#include "core/render/prepared_engine.h"

namespace pellucid::cli {

/// Images of one scene within a tolerance: by the engine, or by the exact reference where no plan
/// keeps the tolerance, unless the memory is short or the scene fixes the interpolation.
class Renderer {
public:
    /// The scene must outlive it. *Throws* Error{outOfMemory}, Cancelled.
    Renderer(const render::Scene &scene, const classify::DensityField &field,
             const render::Budget &budget, const Context &context);

    /// `times`: of this image.
    render::ProjectionImage image(const render::Camera &camera, render::FrameTimes &times);

    /// What makes the images, one line.
    std::string description() const;
    nlohmann::json planJson() const;
    std::size_t bytes() const { return m_bytes; }
    bool isReduced() const { return m_fitting.reduction > 1; }
    const std::string &reason() const { return m_fitting.plan.reason; }
    double predictedError() const;
    /// Of the engine only: the reference's lies below what a float image holds.
    std::optional<double> predictedMaximum() const;

private:
    const render::Scene &m_scene;
    render::FieldSummary m_summary;
    render::FittingPlan m_fitting;
    volume::Lattice m_lattice; ///< of what the engine renders
    std::size_t m_bytes = 0;
    std::unique_ptr<render::CpuEngine> m_engine;
    std::unique_ptr<reference::WideKernel> m_reference;
};

} // namespace pellucid::cli
