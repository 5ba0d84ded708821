// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/open_study.h"

namespace pellucid::ui {

OpenStudy::OpenStudy(GraphicsCard &card)
    : preparer(document, jobs), copier(document, jobs, card), opener(document, jobs, preparer),
      segments(document, jobs, preparer), phases(document, opener, jobs),
      regions(document, preparer.steps()) {
    QObject::connect(&preparer, &LookPreparer::engineReady, &copier, &CardCopier::show);
    QObject::connect(&opener, &StudyOpener::segmentationsFound, &segments, &SegmentOpener::open);
}

OpenStudy::~OpenStudy() {
    // The work of a job, and the functions that it calls when it ends, refer to the members below
    // `jobs`, which are destroyed before it.
    jobs.join();
    regions.jobs().join();
}

} // namespace pellucid::ui
