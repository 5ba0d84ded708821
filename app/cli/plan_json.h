// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/plan/frame_model.h"

namespace pellucid::cli {

/// The plan by which an engine renders a scene, and the model of its last frame. `lattice`: of the
/// rendered fields.
nlohmann::json planJson(const plan::RenderPlan &plan, const scene::Scene &scene,
                        const plan::FrameFields &fields, const volume::Lattice &lattice,
                        std::span<const double> widthShares);

/// The same keys for the exact reference, see `prepare::PreparedEngine::exact`. `reason`: why it
/// renders the images.
nlohmann::json exactPlanJson(int images, const plan::RenderPlan &plan, const std::string &reason);
/// The same keys for pictures from sums along the view, see `prepare::PreparedEngine::sums`.
nlohmann::json sumPlanJson(int images, const plan::RenderPlan &plan);

} // namespace pellucid::cli
