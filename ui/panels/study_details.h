// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/studies/study_facts.h"

class QWidget;

namespace pellucid::ui {

/// Shows what is known of a volume, beside the window: patient, study, series, geometry with its
/// warnings, files. Texts can be selected and copied.
void showStudyDetails(const StudyFacts &study, const VolumeFacts &volume, const QStringList &files,
                      const QImage &thumbnail, QWidget *parent);

} // namespace pellucid::ui
