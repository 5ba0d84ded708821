// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/prepare/prepared_engine.h"
#include "core/task/reason.h"
#include "gpu/gpu_engine.h"

namespace pellucid::ui {

/// The engines of the projection: one on the processor and, if there is one, its copy on the
/// graphics card, which is used until it fails.
struct ShownEngine {
    prepare::PreparedEngine prepared;
    std::shared_ptr<gpu::GpuEngine> onCard;
    task::Reason reason; ///< why that one is in use
};

} // namespace pellucid::ui
