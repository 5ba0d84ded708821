// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/document/document.h"
#include "ui/engine/card_copier.h"
#include "ui/engine/look_preparer.h"
#include "ui/engine/region_finder.h"
#include "ui/jobs/job_runner.h"
#include "ui/opening/phases.h"
#include "ui/opening/segment_opener.h"
#include "ui/opening/study_opener.h"

namespace pellucid::ui {

class GraphicsCard;

/// A document with its jobs and everything that works on it, connected: what opens studies,
/// prepares the projection and copies it to the graphics card. It needs no window.
struct OpenStudy {
    explicit OpenStudy(GraphicsCard &card);
    /// Joins the jobs while everything that they refer to still exists.
    ~OpenStudy();
    OpenStudy(const OpenStudy &) = delete;
    OpenStudy &operator=(const OpenStudy &) = delete;

    Document document;
    JobRunner jobs;
    LookPreparer preparer;
    CardCopier copier;
    StudyOpener opener;
    SegmentOpener segments;
    Phases phases;
    RegionFinder regions;
};

} // namespace pellucid::ui
