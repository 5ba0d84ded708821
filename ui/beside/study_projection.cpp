// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/beside/study_projection.h"

#include "ui/engine/graphics_card.h"
#include "ui/opening/open_study.h"
#include "ui/views/projection_view.h"

namespace pellucid::ui {

void connectProjection(OpenStudy &study, ProjectionView &projection, GraphicsCard &card) {
    const auto deliver = [&projection](auto &from, auto signalled, auto slot) {
        QObject::connect(&from, signalled, &projection, slot);
    };
    deliver(study.copier, &CardCopier::engineReady, &ProjectionView::setEngine);
    deliver(study.preparer, &LookPreparer::planChanged, &ProjectionView::setPlanState);
    deliver(study.opener, &StudyOpener::notProjectable, &ProjectionView::setMessage);
    deliver(study.jobs, &JobRunner::started, &ProjectionView::jobStarted);
    deliver(study.jobs, &JobRunner::finished, &ProjectionView::jobEnded);
    deliver(study.jobs, &JobRunner::failed, &ProjectionView::jobFailed);
    ProjectionFrames &frames = projection.frames();
    QObject::connect(&study.opener, &StudyOpener::phaseLeft, &frames,
                     &ProjectionFrames::holdExposure);
    QObject::connect(&frames, &ProjectionFrames::cardFailed, &card, &GraphicsCard::giveUp);
}

} // namespace pellucid::ui
