// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study_source.h"

#include <QCoreApplication>

#include "core/phantom/phantom.h"

namespace pellucid::ui {

namespace {

QString tr(const char *text) {
    return QCoreApplication::translate("StudySource", text);
}

QString sizeText(const volume::Lattice &l) {
    return QString::fromUtf8("%1 × %2 × %3\n%4 × %5 × %6 mm")
        .arg(l.size().k)
        .arg(l.size().j)
        .arg(l.size().i)
        .arg(l.spacingMm(0), 0, 'f', 2)
        .arg(l.spacingMm(1), 0, 'f', 2)
        .arg(l.sliceDistanceMm(), 0, 'f', 2);
}

QString dated(const std::string &date) {
    const QString d = QString::fromStdString(date);
    return d.size() == 8 ? d.left(4) + "-" + d.mid(4, 2) + "-" + d.right(2) : d;
}

} // namespace

std::vector<StudySource> sourcesFrom(const std::shared_ptr<const dicom::Catalogue> &catalogue) {
    std::vector<StudySource> sources;
    for (const dicom::Selection &s : dicom::selections(*catalogue)) {
        StudySource source;
        source.patient = QString::fromStdString(s.patient->name).replace('^', ' ').simplified();
        if (source.patient.isEmpty())
            source.patient = QString::fromStdString(s.patient->id).isEmpty()
                                 ? tr("Without name")
                                 : QString::fromStdString(s.patient->id);
        source.study = (dated(s.study->date) + " " + QString::fromStdString(s.series->modality) +
                        " " + QString::fromStdString(s.study->description))
                           .simplified();
        const QString description = QString::fromStdString(s.series->description);
        source.series = QString("%1 %2")
                            .arg(s.series->number)
                            .arg(description.isEmpty() ? QString::fromStdString(s.series->modality)
                                                       : description);
        if (!s.volume->label.empty())
            source.series += ", " + QString::fromStdString(s.volume->label);
        source.detail = sizeText(s.volume->geometry.lattice);
        for (const std::string &warning : s.volume->notes.warnings)
            source.warnings << QString::fromStdString(warning);
        source.placed = s.volume->placed;
        const auto part = [](const std::string &text) { return QString::fromStdString(text); };
        source.patientKey = part(s.patient->id) + "\n" + part(s.patient->name);
        source.studyKey = source.patientKey + "\n" + part(s.study->uid);
        source.key = source.studyKey + "\n" + part(s.series->uid) + "\n" + part(s.volume->label) +
                     "\n" + source.detail + "\n" + part(s.volume->nrrd.string());
        // The catalogue is kept alive by whoever may load from it.
        source.load = [catalogue, entry = s.volume](const task::Progress &progress,
                                                    const dicom::LoadObserver &observer) {
            return dicom::loadVolume(*entry, progress, observer);
        };
        sources.push_back(std::move(source));
    }
    return sources;
}

std::size_t defaultSource(const dicom::Catalogue &catalogue) {
    const auto all = dicom::selections(catalogue);
    const dicom::VolumeEntry *const wanted = dicom::defaultSelection(catalogue).volume;
    std::size_t n = 0;
    while (all[n].volume != wanted)
        ++n;
    return n;
}

StudySource phantomSource(const QString &name) {
    const phantom::Kind kind = phantom::kindFromName(name.toStdString());
    const volume::Lattice lattice = phantom::phantomLattice(kind, {});
    StudySource source;
    source.patient = tr("Phantoms");
    source.study = tr("Made by Pellucid");
    source.series = name == "head"    ? tr("Head phantom")
                    : name == "chest" ? tr("Chest phantom")
                                      : name;
    source.detail = sizeText(lattice);
    source.patientKey = source.studyKey = "phantoms";
    source.key = "phantoms\n" + name;
    source.load = [kind, lattice](const task::Progress &progress, const dicom::LoadObserver &) {
        return dicom::LoadedVolume{phantom::makePhantom(kind, lattice, progress), {}};
    };
    return source;
}

} // namespace pellucid::ui
