// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QString>

#include "ui/engine/look_preparer.h"
#include "ui/engine/render_worker.h"

namespace pellucid::ui {

/// A picture on the screen and what its figures report.
struct DescribedFrame {
    const RenderedFrame &frame;
    std::optional<double> error; ///< against the study, if known
    EngineStage stage = EngineStage::coarse;
    PlanState planState = PlanState::holds;
    bool isPending = false; ///< a newer picture was requested
};

/// Engine, time and error of a picture: "CPU  12.3 ms  error 0.021 %".
QString figuresText(const DescribedFrame &described);

} // namespace pellucid::ui
