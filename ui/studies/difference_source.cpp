// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/difference_source.h"

#include <utility>

#include <QCoreApplication>

#include <glm/geometric.hpp>

#include "core/subtraction/difference.h"
#include "core/task/naming.h"
#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

struct DifferenceTexts {
    Q_DECLARE_TR_FUNCTIONS(DifferenceTexts)
};

// What the alignment found, or why one is needed.
QString noteOn(const subtraction::Subtraction &made) {
    if (made.needsAlignment)
        return DifferenceTexts::tr("not aligned, although the frames of reference differ");
    if (!made.registration)
        return {};
    constexpr double radToDeg = 180.0 / 3.14159265358979323846;
    const auto number = [](double value, int digits) {
        return QString::number(value, 'f', digits);
    };
    const subtraction::Registration &r = *made.registration;
    return DifferenceTexts::tr(
               "aligned: turned by %1°, moved by %2 mm; RMS difference %3, before %4")
        .arg(number(r.toMoving.angleRad() * radToDeg, 2),
             number(glm::length(r.toMoving.shiftMm), 1), number(r.residualAfter, 1),
             number(r.residualBefore, 1));
}

// Errors without a file are those of the source.
dicom::LoadedVolume loadNaming(const StudySource &source, const task::Progress &progress) {
    return task::naming(source.place().toStdString(), [&] { return source.load(progress, {}); });
}

} // namespace

StudySource differenceSource(const StudySource &minuend, const StudySource &subtrahend,
                             bool isAligned, RenameSource onLoaded) {
    StudySource source;
    source.study = minuend.study;
    source.study.libraryId = 0;
    source.volume = minuend.volume;
    VolumeFacts &facts = source.volume;
    // It belongs to no series and is in no library.
    facts.seriesUid = QString("difference %1 %2%3")
                          .arg(minuend.digest().left(16), subtrahend.digest().left(16),
                               isAligned ? " aligned" : "");
    facts.file.clear();
    facts.label.clear();
    facts.libraryId = 0;
    facts.isCopied = false;
    QString name = facts.description.isEmpty() ? facts.modality : facts.description;
    if (!minuend.volume.label.empty())
        name += ", " + translated(minuend.volume.label);
    facts.description = DifferenceTexts::tr("%1 minus %2").arg(name, seriesText(subtrahend.volume));
    source.files = minuend.files + subtrahend.files;
    source.files.removeDuplicates();
    facts.files = int(source.files.size());
    source.lasting = minuend.lasting + subtrahend.lasting;
    source.lasting.removeDuplicates();
    source.difference = {minuend.digest(), subtrahend.digest(), isAligned};
    source.makeThumbnail = minuend.makeThumbnail;
    source.load = [minuend, subtrahend, isAligned, key = source.key(), name = facts.description,
                   onLoaded = std::move(onLoaded)](const task::Progress &progress,
                                                   const dicom::LoadObserver &) {
        dicom::LoadedVolume from = loadNaming(minuend, progress.part(0.0, 0.3));
        const dicom::LoadedVolume with = loadNaming(subtrahend, progress.part(0.3, 0.6));
        subtraction::Subtraction made =
            subtraction::subtract(from.volume, with.volume, isAligned, progress.part(0.6, 1.0));
        if (const QString note = noteOn(made); onLoaded && !note.isEmpty())
            onLoaded(key, name + "; " + note);
        from.skipped.insert(from.skipped.end(), with.skipped.begin(), with.skipped.end());
        return dicom::LoadedVolume{std::move(made.difference), std::move(from.skipped)};
    };
    return source;
}

} // namespace pellucid::ui
