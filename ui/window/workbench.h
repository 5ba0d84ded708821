// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/document.h"
#include "ui/document/measurement_store.h"
#include "ui/engine/card_copier.h"
#include "ui/engine/graphics_card.h"
#include "ui/engine/look_preparer.h"
#include "ui/jobs/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/opening/phases.h"
#include "ui/opening/session.h"
#include "ui/opening/study_opener.h"

namespace pellucid::ui {

/// Everything that is behind the window, connected with each other: what is open, and what works on
/// it. A window can be made anew over it, in another language or theme, and nothing is lost.
struct Workbench {
    /// `engine`: of this run alone; else what was chosen before.
    explicit Workbench(std::optional<EngineChoice> engine = std::nullopt);
    ~Workbench();
    Workbench(const Workbench &) = delete;
    Workbench &operator=(const Workbench &) = delete;

    Document document;
    JobRunner jobs, exports;
    StudyLibrary library;
    LookPreparer preparer;
    GraphicsCard card;
    CardCopier copier;
    StudyOpener opener;
    Phases phases;
    MeasurementStore measurements;
    SessionFile session;
};

} // namespace pellucid::ui
