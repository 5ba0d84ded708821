// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/difference_source.h"

#include <chrono>
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

// Describes an alignment: how far the patient had moved, and the residual.
QString noteOn(const subtraction::Registration &r) {
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

QString nameOf(const StudySource &minuend) {
    const VolumeFacts &facts = minuend.volume;
    const QString name = facts.description.isEmpty() ? facts.modality : facts.description;
    return facts.label.empty() ? name : name + ", " + translated(facts.label);
}

// Errors without a file are those of the source.
dicom::LoadedVolume loadNaming(const StudySource &source, const task::Progress &progress) {
    return task::naming(source.place().toStdString(), [&] { return source.load(progress, {}); });
}

// A source that is made of two others, as a volume of the first one's study. `uid`: in place of the
// series, to which it does not belong.
StudySource pairSource(const StudySource &minuend, const StudySource &subtrahend,
                       const QString &uid) {
    StudySource source;
    source.study = minuend.study;
    source.study.libraryId = 0;
    source.volume = minuend.volume;
    VolumeFacts &facts = source.volume;
    facts.seriesUid = uid;
    facts.file.clear();
    facts.label.clear();
    facts.libraryId = 0; // it is in no library
    facts.isCopied = false;
    source.files = minuend.files + subtrahend.files;
    source.files.removeDuplicates();
    facts.files = int(source.files.size());
    source.lasting = minuend.lasting + subtrahend.lasting;
    source.lasting.removeDuplicates();
    source.makeThumbnail = minuend.makeThumbnail;
    return source;
}

// Both volumes of such a source, in the first part of a load's progress.
struct LoadedPair {
    dicom::LoadedVolume first, second;

    LoadedPair(const StudySource &minuend, const StudySource &subtrahend,
               const task::Progress &progress)
        : first(loadNaming(minuend, progress.part(0.0, 0.3))),
          second(loadNaming(subtrahend, progress.part(0.3, 0.6))) {}

    // The result, with the skipped files of both.
    dicom::LoadedVolume with(volume::Volume made) {
        first.skipped.insert(first.skipped.end(), second.skipped.begin(), second.skipped.end());
        return {std::move(made), std::move(first.skipped)};
    }
};

} // namespace

subtraction::Registration Alignment::of(const volume::Volume &minuend,
                                        const volume::Volume &subtrahend,
                                        const task::Progress &progress) {
    constexpr std::chrono::milliseconds betweenChecks(50);
    std::unique_lock lock(m_mutex, std::defer_lock);
    while (!lock.try_lock_for(betweenChecks)) // another source finds it
        progress.check();
    if (!m_found)
        m_found = subtraction::registerRigidly(minuend, subtrahend, progress);
    return *m_found;
}

StudySource differenceSource(const StudySource &minuend, const StudySource &subtrahend,
                             std::shared_ptr<Alignment> alignment, RenameSource onLoaded) {
    StudySource source =
        pairSource(minuend, subtrahend,
                   QString("difference %1 %2%3")
                       .arg(minuend.digest().left(16), subtrahend.digest().left(16),
                            alignment ? " aligned" : ""));
    QString &name = source.volume.description;
    name = DifferenceTexts::tr("%1 minus %2").arg(nameOf(minuend), seriesText(subtrahend.volume));
    source.difference = {minuend.digest(), subtrahend.digest(), alignment != nullptr};
    source.load = [minuend, subtrahend, alignment, key = source.key(), name,
                   onLoaded = std::move(onLoaded)](const task::Progress &progress,
                                                   const dicom::LoadObserver &) {
        LoadedPair pair(minuend, subtrahend, progress);
        const volume::Volume &a = pair.first.volume, &b = pair.second.volume;
        const task::Progress rest = progress.part(0.6, 1.0);
        if (!alignment) {
            subtraction::Subtraction made =
                subtraction::subtract(a, b, subtraction::Registering::none, {}, rest);
            if (made.needsAlignment && onLoaded)
                onLoaded(key, name + "; " +
                                  DifferenceTexts::tr(
                                      "not aligned, although the frames of reference differ"));
            return pair.with(std::move(made.difference));
        }
        const auto found = alignment->of(a, b, rest.part(0.0, 0.8));
        if (onLoaded)
            onLoaded(key, name + "; " + noteOn(found));
        return pair.with(subtraction::difference(a, b, found.toMoving, {}, rest.part(0.8, 1.0)));
    };
    return source;
}

StudySource alignedSource(const StudySource &minuend, const StudySource &subtrahend,
                          const std::shared_ptr<Alignment> &alignment) {
    StudySource source = pairSource(
        minuend, subtrahend,
        QString("aligned %1 %2").arg(minuend.digest().left(16), subtrahend.digest().left(16)));
    source.volume.description = DifferenceTexts::tr("%1 aligned with %2")
                                    .arg(seriesText(subtrahend.volume), nameOf(minuend));
    source.load = [minuend, subtrahend, alignment](const task::Progress &progress,
                                                   const dicom::LoadObserver &) {
        LoadedPair pair(minuend, subtrahend, progress);
        const volume::Volume &a = pair.first.volume, &b = pair.second.volume;
        const auto found = alignment->of(a, b, progress.part(0.6, 0.9));
        return pair.with(subtraction::onLatticeOf(a, b, found.toMoving, progress.part(0.9, 1.0)));
    };
    return source;
}

} // namespace pellucid::ui
