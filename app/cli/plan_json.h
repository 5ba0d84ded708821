// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/plan/frame_model.h"

namespace pellucid::cli {

/// How an engine makes the images of a scene, and the frame that results. *Shape*: the lattice is
/// that of the rendered fields.
nlohmann::json planJson(const plan::RenderPlan &plan, const scene::Scene &scene,
                        const plan::FrameFields &fields, const volume::Lattice &lattice);

/// The same keys where the exact reference makes them, and why it does.
nlohmann::json exactPlanJson(std::size_t images, std::size_t bytes, double predictedError,
                             const std::string &reason);

} // namespace pellucid::cli
