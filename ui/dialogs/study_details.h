// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/studies/study_facts.h"

class QWidget;

namespace pellucid::ui {

/// Shows a non-modal dialog with the patient, study, series, geometry, warnings and files of a
/// volume. Texts can be selected and copied.
void showStudyDetails(const StudyFacts &study, const VolumeFacts &volume, const QStringList &files,
                      const QImage &thumbnail, QWidget *parent);

} // namespace pellucid::ui
