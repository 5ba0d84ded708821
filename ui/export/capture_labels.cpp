// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/capture_labels.h"

#include "ui/document/document.h"

namespace pellucid::ui {

dicom::CaptureLabels studyLabels(const Document &document) {
    const StudyFacts &study = document.sources().at(std::size_t(document.currentSource())).study;
    dicom::CaptureLabels labels;
    if (document.volume())
        for (const task::Reason &warning : document.volume()->notes().warnings)
            labels.warnings.push_back(warning.english());
    if (!study.hasPatient())
        return labels;
    labels.patientId = study.patientId.toStdString();
    labels.patientName = study.patientName.toStdString();
    labels.birthDate = study.birthDate.toStdString();
    labels.sex = study.sex.toStdString();
    labels.studyUid = study.uid.toStdString();
    labels.studyDate = study.date.toStdString();
    labels.studyDescription = study.description.toStdString();
    return labels;
}

} // namespace pellucid::ui
