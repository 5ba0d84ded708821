// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/difference_source.h"

#include <filesystem>
#include <utility>

#include <QCoreApplication>

#include <glm/geometric.hpp>

#include "core/subtraction/difference.h"
#include "core/task/error.h"
#include "ui/language/reasons.h"

namespace pellucid::ui {

namespace {

struct DifferenceTexts {
    Q_DECLARE_TR_FUNCTIONS(DifferenceTexts)
};

QString textOf(const subtraction::Registration &r) {
    constexpr double radToDeg = 180.0 / 3.14159265358979323846;
    const auto number = [](double value, int digits) {
        return QString::number(value, 'f', digits);
    };
    return DifferenceTexts::tr(
               "aligned: turned by %1°, moved by %2 mm; RMS difference %3, before %4")
        .arg(number(r.toMoving.angleRad() * radToDeg, 2),
             number(glm::length(r.toMoving.shiftMm), 1), number(r.residualAfter, 1),
             number(r.residualBefore, 1));
}

// Errors without a file are those of the second volume.
dicom::LoadedVolume loadNaming(const StudySource &source, const task::Progress &progress) {
    try {
        return source.load(progress, {});
    } catch (const task::Error &error) {
        throw task::Error(error.code(), error.reason(),
                          error.path().empty() ? std::filesystem::path(source.place().toStdString())
                                               : error.path());
    }
}

dicom::LoadedVolume load(const StudySource &minuend, const StudySource &subtrahend, bool isAligned,
                         const DifferenceNote &onLoaded, const task::Progress &progress) {
    dicom::LoadedVolume from = loadNaming(minuend, progress.part(0.0, 0.3));
    dicom::LoadedVolume with = loadNaming(subtrahend, progress.part(0.3, 0.6));
    subtraction::RigidTransform transform;
    QString note;
    if (isAligned) {
        const subtraction::Registration found =
            subtraction::registerRigidly(from.volume, with.volume, progress.part(0.6, 0.9));
        transform = found.toMoving;
        note = textOf(found);
    } else if (from.volume.notes().frameOfReferenceUid != with.volume.notes().frameOfReferenceUid) {
        note = DifferenceTexts::tr("not aligned, although the frames of reference differ");
    }
    std::vector<dicom::Skipped> skipped = std::move(from.skipped);
    skipped.insert(skipped.end(), with.skipped.begin(), with.skipped.end());
    dicom::LoadedVolume loaded{
        subtraction::difference(from.volume, with.volume, transform, progress.part(0.9, 1.0)),
        std::move(skipped)};
    if (onLoaded && !note.isEmpty())
        onLoaded(note);
    return loaded;
}

} // namespace

StudySource differenceSource(const StudySource &minuend, const StudySource &subtrahend,
                             bool isAligned, DifferenceNote onLoaded) {
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
    source.load = [minuend, subtrahend, isAligned, onLoaded = std::move(onLoaded)](
                      const task::Progress &progress, const dicom::LoadObserver &) {
        return load(minuend, subtrahend, isAligned, onLoaded, progress);
    };
    return source;
}

} // namespace pellucid::ui
