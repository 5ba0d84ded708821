// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <QImage>
#include <QString>
#include <QStringList>

#include <glm/vec3.hpp>

#include "core/dicom/catalogue.h"
#include "core/task/reason.h"

namespace pellucid::ui {

/// Where the volumes of a study are from.
enum class Origin { patient, volumeFiles, phantom };

/// What a list of studies shows about a study. Names are for display only: never put them in a log,
/// a title or a file name.
struct StudyFacts {
    QString patientId, patientName, birthDate, sex; ///< as in the headers: Name^First, YYYYMMDD
    Origin origin = Origin::patient;
    QString uid, date, description;
    QString modalities; ///< of its series, separated by spaces
    /// Identifier in the library; 0: open, but not in the library.
    qint64 libraryId = 0;

    /// Distinguishes patients and studies. Names alone may be equal.
    QString patientKey() const { return patientId + "\n" + patientName; }
    QString key() const { return patientKey() + "\n" + uid; }
    /// False for phantoms and for volume files, which contain no patient data.
    bool hasPatient() const;
};

/// What a list of studies shows about a volume.
struct VolumeFacts {
    QString seriesUid, modality, bodyPart, description;
    std::vector<task::Reason> label; ///< distinguishes it from the other volumes of its series
    int seriesNumber = 0;
    volume::GridSize size{};
    glm::dvec3 spacingMm{0.0}; ///< of columns, rows and slices; 0: unknown
    /// The first sample's place, of an open volume. *Units*: LPS, mm.
    std::optional<glm::dvec3> originMm;
    double tiltDeg = 0.0;
    bool placed = true; ///< false: images only
    std::vector<task::Reason> warnings;
    QString file; ///< for a volume that is a single file
    int files = 0;
    /// Identifier in the library; 0: open, but not in the library.
    qint64 libraryId = 0;
    bool isCopied = false; ///< its files are copies in the library
    QImage thumbnail;
    /// Number of similar volumes that a row of a list represents.
    int phases = 1;

    /// Distinguishes the volumes of a study.
    QString key() const;
};

/// Whether two volumes of a study have the same position and size, and differ only in time, echo or
/// the like: volumes of one series, or series whose descriptions differ only in their phase.
bool arePhases(const VolumeFacts &a, const VolumeFacts &b);

StudyFacts studyFacts(const dicom::Selection &selection);
VolumeFacts volumeFacts(const dicom::Selection &selection);

/// "Doe Jane", or the identifier if there is no name.
QString patientText(const StudyFacts &study);

/// A name as DICOM writes it, with blanks between its parts and groups.
QString personText(const QString &name);
/// "2007-04-04 CT Chest".
QString studyText(const StudyFacts &study);
/// "3 5 mm soft kernel", with the number of the series first.
QString seriesText(const VolumeFacts &volume);
/// Size and, if known, spacing: one line or two.
QString sizeText(const VolumeFacts &volume);
/// Warnings about its geometry, in the user's language.
QStringList warningTexts(const VolumeFacts &volume);
/// Formats "20070404" as "2007-04-04".
QString dateText(const QString &date);

} // namespace pellucid::ui
