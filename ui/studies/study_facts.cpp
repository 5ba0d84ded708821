// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/study_facts.h"

#include <algorithm>
#include <optional>

#include <QCoreApplication>
#include <QRegularExpression>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "core/volume/reasons.h"
#include "ui/language/reasons.h"
#include "ui/language/shown_text.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;

struct StudyFactsTexts {
    Q_DECLARE_TR_FUNCTIONS(StudyFactsTexts)
};

QString text(const std::string &utf8) {
    return QString::fromStdString(utf8);
}

// The part of a label that distinguishes stacks that are not phases of each other: they differ in
// direction, space or kind of values. The scan puts it last.
std::optional<task::Reason> stackOf(const std::vector<task::Reason> &label) {
    if (label.empty())
        return std::nullopt;
    const auto is = [&](auto... stacks) { return (label.back().is(stacks) || ...); };
    return is(because::axial, because::axialNumber, because::coronal, because::coronalNumber,
              because::sagittal, because::sagittalNumber, because::images, because::imagesNumber)
               ? std::optional(label.back())
               : std::nullopt;
}

// Gated and dynamic scans often write a series for each phase: "Gated, 40%", "CTA phase 3". The
// description without the number of the phase; empty if it has none. A percentage may also be the
// strength of an iterative reconstruction: "Chest ASiR-V 30%". But "low dose 75%" and "SS40 75%"
// are phases.
QString phaseName(const QString &description) {
    static const QRegularExpression number(
        "\\d+(?:\\.\\d+)?\\s*%|(?:phase|dyn(?:amic)?|time\\s*point|\\btp)[\\s_#-]*\\d+",
        QRegularExpression::CaseInsensitiveOption);
    static const QRegularExpression endsWithReconstruction(
        "(?:asir(?:[\\s_-]*v)?|\\bir|blend(?:ing)?|admire|safire|idose|aidr)[\\s:=_(-]*$",
        QRegularExpression::CaseInsensitiveOption);
    for (auto all = number.globalMatch(description); all.hasNext();) {
        const auto found = all.next();
        const bool isPercentage = found.captured().endsWith('%');
        if (isPercentage &&
            endsWithReconstruction.match(description.left(found.capturedStart())).hasMatch())
            continue;
        return QString(description).replace(found.capturedStart(), found.capturedLength(), "#");
    }
    return {};
}

// Positions in files are rounded.
bool isClose(const glm::dvec3 &a, const glm::dvec3 &b) {
    constexpr double toleranceMm = 1e-3;
    return glm::all(glm::lessThanEqual(glm::abs(a - b), glm::dvec3(toleranceMm)));
}

// Series of one scan that differ in the phase that their descriptions name; or dynamic scans, whose
// series have one description and one place. (Two CT series alike may differ in their kernel.)
bool areSeriesOfPhases(const VolumeFacts &a, const VolumeFacts &b) {
    if (a.seriesUid.isEmpty() || b.seriesUid.isEmpty() || a.modality != b.modality ||
        a.bodyPart != b.bodyPart)
        return false;
    if (!phaseName(a.description).isEmpty())
        return phaseName(a.description) == phaseName(b.description);
    const bool isDynamic = a.modality == "MR" || a.modality == "PT" || a.modality == "NM";
    return isDynamic && !a.description.isEmpty() && a.description == b.description && a.originMm &&
           b.originMm && isClose(*a.originMm, *b.originMm);
}

} // namespace

bool StudyFacts::hasPatient() const {
    return origin == Origin::patient;
}

QString VolumeFacts::key() const {
    // Files are named after this key: it must not depend on the language or change between
    // versions.
    return seriesUid + "\n" + text(dicom::labelText(label)) + "\n" +
           QString("%1 %2 %3 %4 %5 %6")
               .arg(QString::number(size.i), QString::number(size.j), QString::number(size.k),
                    QString::number(spacingMm.x, 'f', 2), QString::number(spacingMm.y, 'f', 2),
                    QString::number(spacingMm.z, 'f', 2)) +
           "\n" + file;
}

StudyFacts studyFacts(const dicom::Selection &s) {
    StudyFacts facts;
    facts.origin = s.patient->isOfVolumeFiles ? Origin::volumeFiles : Origin::patient;
    facts.patientId = text(s.patient->id);
    facts.patientName = text(s.patient->name);
    facts.birthDate = text(s.patient->birthDate);
    facts.sex = text(s.patient->sex);
    facts.uid = text(s.study->uid);
    facts.date = text(s.study->date);
    facts.description = text(s.study->description);
    QStringList modalities;
    for (const dicom::Series &series : s.study->series)
        if (const QString modality = text(series.modality);
            !modality.isEmpty() && !modalities.contains(modality))
            modalities << modality;
    facts.modalities = modalities.join(' ');
    return facts;
}

VolumeFacts volumeFacts(const dicom::Selection &s) {
    const volume::Lattice &lattice = s.volume->geometry.lattice;
    VolumeFacts facts;
    facts.seriesUid = text(s.series->uid);
    facts.modality = text(s.series->modality);
    facts.bodyPart = text(s.series->bodyPart);
    facts.description = text(s.series->description);
    facts.label = s.volume->label;
    facts.seriesNumber = s.series->number;
    facts.size = lattice.size();
    if (s.volume->notes.hasSpacing)
        facts.spacingMm = {lattice.spacingMm(0), lattice.spacingMm(1),
                           s.volume->notes.hasDepth ? lattice.sliceDistanceMm() : 0.0};
    if (s.volume->placed)
        facts.originMm = lattice.origin().mm;
    facts.tiltDeg = lattice.shearRad() * 180.0 / 3.14159265358979323846;
    facts.placed = s.volume->placed;
    facts.warnings = s.volume->notes.warnings;
    facts.file = text(s.volume->volumeFile.string());
    facts.files = int(s.series->files.size());
    return facts;
}

QString personText(const QString &name) {
    return shownText(name).replace('^', ' ').replace('=', ' ').simplified();
}

QString patientText(const StudyFacts &study) {
    if (study.origin == Origin::phantom)
        return StudyFactsTexts::tr("Phantoms");
    if (study.origin == Origin::volumeFiles)
        return StudyFactsTexts::tr("Files");
    const QString name = personText(study.patientName);
    if (!name.isEmpty())
        return name;
    return study.patientId.isEmpty() ? StudyFactsTexts::tr("Unnamed") : shownText(study.patientId);
}

QString studyText(const StudyFacts &study) {
    if (study.origin == Origin::volumeFiles)
        return StudyFactsTexts::tr("Volume files");
    const QString result =
        shownText(dateText(study.date) + " " + study.modalities + " " + study.description)
            .simplified();
    return result.isEmpty() ? StudyFactsTexts::tr("Study") : result;
}

bool arePhases(const VolumeFacts &a, const VolumeFacts &b) {
    const bool isOneSeries = !a.seriesUid.isEmpty() ? a.seriesUid == b.seriesUid
                                                    : !a.file.isEmpty() && b.seriesUid.isEmpty();
    return (isOneSeries || areSeriesOfPhases(a, b)) && a.file == b.file && a.placed && b.placed &&
           a.size == b.size && isClose(a.spacingMm, b.spacingMm) &&
           stackOf(a.label) == stackOf(b.label);
}

QString seriesText(const VolumeFacts &volume) {
    if (volume.size.count() == 0) // it begins to arrive, and nothing more is known
        return shownText(volume.description);
    QString result = QString::number(volume.seriesNumber) + ": " +
                     shownText(volume.description.isEmpty() ? volume.modality : volume.description);
    if (volume.phases > 1)
        result += ", " + StudyFactsTexts::tr("%n phases", "", volume.phases);
    else if (!volume.label.empty())
        result += ", " + translated(volume.label);
    return result;
}

QString sizeText(const VolumeFacts &v) {
    if (v.size.count() == 0)
        return {};
    QString result =
        QString::fromUtf8("%1 × %2 × %3")
            .arg(QString::number(v.size.i), QString::number(v.size.j), QString::number(v.size.k));
    if (v.spacingMm.x > 0.0)
        result += QString::fromUtf8("\n%1 × %2")
                      .arg(QString::number(v.spacingMm.x, 'f', 2),
                           QString::number(v.spacingMm.y, 'f', 2));
    if (v.spacingMm.z > 0.0)
        result += QString::fromUtf8(" × %1").arg(v.spacingMm.z, 0, 'f', 2);
    return v.spacingMm.x > 0.0 ? result + " mm" : result;
}

QStringList warningTexts(const VolumeFacts &volume) {
    QStringList texts;
    for (const task::Reason &warning : volume.warnings)
        texts << translated(warning);
    return texts;
}

QString dateText(const QString &date) {
    const QString shown = shownText(date);
    return shown.size() == 8 ? shown.left(4) + "-" + shown.mid(4, 2) + "-" + shown.right(2) : shown;
}

} // namespace pellucid::ui
