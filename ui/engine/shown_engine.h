// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/prepare/prepared_engine.h"
#include "core/task/reason.h"
#include "gpu/gpu_engine.h"

namespace pellucid::ui {

/// What makes the frames of the projection: an engine on the processor and, where there is one, its
/// twin on the graphics card, which is used as long as it lasts.
struct ShownEngine {
    prepare::PreparedEngine prepared;
    std::shared_ptr<gpu::GpuEngine> onCard;
    double predictedError = 0.0; ///< of the one that is used
    task::Reason reason;         ///< why it is that one
};

} // namespace pellucid::ui
