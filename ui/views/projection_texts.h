// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QString>

#include "core/error/stated_error.h"
#include "core/scene/positioner_angles.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/render_worker.h"

namespace pellucid::ui {

/// A picture on the screen and what its figures report.
struct DescribedFrame {
    const RenderedFrame &frame;
    std::optional<error::StatedError> error; ///< against the study, if known
    EngineStage stage = EngineStage::coarse;
    PlanState planState = PlanState::holds;
    bool isPending = false; ///< a newer picture was requested
};

/// Engine, time and error of a picture: "CPU  12.3 ms  error ≤ 0.11 %" while the picture is new,
/// "error 0.021 % measured" when it rests.
QString figuresText(const DescribedFrame &described);
/// The error alone: "≤ 0.11 %", "0.021 % measured".
QString errorFigure(const error::StatedError &error);
/// What a stated error means, a sentence.
QString errorExplanation(const error::StatedError &error);

/// The angles of a view: "LAO 30° CRA 20°".
QString anglesText(const scene::PositionerAngles &angles);

} // namespace pellucid::ui
