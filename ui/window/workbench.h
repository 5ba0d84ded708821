// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/document/measurement_store.h"
#include "ui/document/notices.h"
#include "ui/engine/graphics_card.h"
#include "ui/jobs/job_runner.h"
#include "ui/library/study_library.h"
#include "ui/opening/open_study.h"
#include "ui/opening/session.h"
#include "ui/servers/earlier_studies.h"
#include "ui/servers/server_book.h"
#include "ui/servers/server_search.h"
#include "ui/servers/study_receiver.h"
#include "ui/servers/transfer_queue.h"

namespace pellucid::ui {

/// Everything behind the window: the open study, the library, and what is kept of them.
struct Workbench {
    /// `engine`: for this run only; none: the choice in the settings.
    explicit Workbench(std::optional<EngineChoice> engine = std::nullopt);
    ~Workbench();
    Workbench(const Workbench &) = delete;
    Workbench &operator=(const Workbench &) = delete;

    GraphicsCard card;
    OpenStudy study;
    Notices notices;
    JobRunner exports;
    StudyLibrary library;
    ServerBook servers;
    ServerSearch serverSearch;
    StudyReceiver receiver;
    TransferQueue transfers;
    EarlierStudies earlier;
    MeasurementStore measurements;
    SessionFile session;
};

} // namespace pellucid::ui
