// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QImage>
#include <QString>
#include <QStringList>

#include <glm/vec3.hpp>

#include "core/dicom/catalogue.h"
#include "core/task/reason.h"

namespace pellucid::ui {

/// What a list of studies says of a study. Names are for the eye only and go into no log, no title
/// and no file name.
struct StudyFacts {
    QString patientId, patientName, birthDate, sex; ///< as in the headers: Name^First, YYYYMMDD
    QString uid, date, description;
    QString modalities; ///< of its series, with spaces
    /// In the library; 0: only open.
    qint64 libraryId = 0;

    /// What tells patients and studies apart; never the names alone, which may be equal.
    QString patientKey() const { return patientId + "\n" + patientName; }
    QString key() const { return patientKey() + "\n" + uid; }
    /// False: a phantom's, or of volume files, which tell of nobody.
    bool hasPatient() const;
};

/// What a list of studies says of a volume.
struct VolumeFacts {
    QString seriesUid, modality, bodyPart, description;
    std::vector<task::Reason> label; ///< what tells it from the other volumes of its series
    int seriesNumber = 0;
    volume::GridSize size{};
    glm::dvec3 spacingMm{0.0}; ///< of columns, rows and slices; 0: unknown
    double tiltDeg = 0.0;
    bool placed = true; ///< false: images only
    std::vector<task::Reason> warnings;
    QString file; ///< of a volume that is one file
    int files = 0;
    /// In the library; 0: only open.
    qint64 libraryId = 0;
    bool isCopied = false; ///< its files are the library's own
    QImage thumbnail;
    /// How many volumes a row of a list stands for; the others are like this one.
    int phases = 1;

    /// What tells the volumes of a study apart.
    QString key() const;
};

/// Whether two volumes of a study differ in time, echo or the like only: same place, same size.
bool arePhases(const VolumeFacts &a, const VolumeFacts &b);

StudyFacts studyFacts(const dicom::Selection &selection);
VolumeFacts volumeFacts(const dicom::Selection &selection);

/// "Doe Jane", the identifier where there is no name.
QString patientText(const StudyFacts &study);
/// "2007-04-04 CT Chest".
QString studyText(const StudyFacts &study);
/// "3 5 mm soft kernel", with the number of the series first.
QString seriesText(const VolumeFacts &volume);
/// Size and, as far as it is known, spacing: one line or two.
QString sizeText(const VolumeFacts &volume);
/// What is to be known of its geometry, in the user's language.
QStringList warningTexts(const VolumeFacts &volume);
/// "2007-04-04" of "20070404".
QString dateText(const QString &date);

} // namespace pellucid::ui
