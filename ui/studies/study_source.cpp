// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/studies/study_source.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QFileInfo>

#include "core/dicom/scan.h"
#include "core/phantom/phantom.h"
#include "core/task/error.h"
#include "ui/studies/reasons.h"
#include "ui/studies/thumbnail.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;
namespace because = task::because;

struct StudySourceTexts {
    Q_DECLARE_TR_FUNCTIONS(StudySourceTexts)
};

// A phantom's thumbnail is made from a small version of it.
constexpr volume::GridSize thumbnailPhantom{96, 96, 96};

// Finds a volume of the library in a new scan. Missing files change its size, but not its label.
const dicom::VolumeEntry &findVolume(const dicom::Catalogue &catalogue, const VolumeFacts &volume) {
    const auto all = dicom::selections(catalogue);
    std::vector<const dicom::VolumeEntry *> alike;
    for (const dicom::Selection &s : all) {
        const VolumeFacts facts = volumeFacts(s);
        if (facts.key() == volume.key())
            return *s.volume;
        if (dicom::labelText(facts.label) == dicom::labelText(volume.label))
            alike.push_back(s.volume);
    }
    if (alike.size() == 1)
        return *alike.front();
    throw task::Error(task::ErrorCode::unusable, because::volumeHasChanged);
}

dicom::LoadedVolume loadFromLibrary(const VolumeFacts &volume,
                                    const std::vector<dicom::InstanceFile> &files,
                                    const task::Progress &progress,
                                    const dicom::LoadObserver &observer) {
    std::vector<fs::path> existing;
    std::vector<dicom::Skipped> skipped;
    for (const dicom::InstanceFile &file : files) {
        std::error_code ignored;
        if (fs::is_regular_file(file.path, ignored))
            existing.push_back(file.path);
        else
            skipped.push_back({file.path, because::isGone});
    }
    if (existing.empty())
        throw task::Error(task::ErrorCode::unusable, because::seriesIsGone,
                          skipped.empty() ? fs::path() : skipped.front().path.parent_path());
    // The files are in the library already: do not refuse huge ones.
    const dicom::Catalogue catalogue =
        dicom::scan(existing, progress.part(0.0, 0.2), {.includesHuge = true});
    skipped.insert(skipped.end(), catalogue.skipped.begin(), catalogue.skipped.end());
    dicom::LoadedVolume loaded =
        dicom::loadVolume(findVolume(catalogue, volume), progress.part(0.2, 1.0), observer);
    loaded.skipped.insert(loaded.skipped.begin(), skipped.begin(), skipped.end());
    return loaded;
}

} // namespace

QString StudySource::place() const {
    return lasting.size() > 1 ? QFileInfo(lasting.front()).path() : lasting.value(0);
}

QString StudySource::digest() const {
    return QCryptographicHash::hash(key().toUtf8(), QCryptographicHash::Sha256).toHex();
}

std::vector<StudySource> sourcesFrom(const std::shared_ptr<const dicom::Catalogue> &catalogue) {
    std::vector<StudySource> sources;
    for (const dicom::Selection &s : dicom::selections(*catalogue)) {
        StudySource source;
        source.study = studyFacts(s);
        source.volume = volumeFacts(s);
        for (const dicom::InstanceFile &file : s.series->files)
            source.files << QString::fromStdString(file.path.string());
        if (s.volume->geometry.frameOffsetsMm.empty())
            for (const dicom::FrameReference &frame : s.volume->frames)
                source.slices << QString::fromStdString(frame.path.string());
        for (const dicom::InstanceFile &file : s.series->files) {
            const auto archive = catalogue->archiveOf(file.path);
            const auto lasting = QString::fromStdString(archive.value_or(file.path).string());
            if (source.lasting.isEmpty() || source.lasting.back() != lasting)
                source.lasting << lasting;
        }
        source.lasting.removeDuplicates();
        for (const dicom::SegmentationFile &file : s.study->segmentations)
            source.segmentations.emplace_back(
                QString::fromStdString(file.path.string()),
                QString::fromStdString(file.description.empty()
                                           ? catalogue->named(file.path).filename().string()
                                           : file.description));
        source.volume.file =
            QString::fromStdString(catalogue->named(s.volume->volumeFile).string());
        // Each function that may load from the catalogue keeps it alive.
        source.load = [catalogue, entry = s.volume](const task::Progress &progress,
                                                    const dicom::LoadObserver &observer) {
            try {
                dicom::LoadedVolume loaded = dicom::loadVolume(*entry, progress, observer);
                for (dicom::Skipped &skipped : loaded.skipped)
                    skipped.path = catalogue->named(skipped.path);
                return loaded;
            } catch (const task::Error &error) {
                throw task::Error(error.code(), error.reason(), catalogue->named(error.path()));
            }
        };
        source.makeThumbnail = [catalogue, entry = s.volume] { return makeThumbnail(*entry); };
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

StudySource librarySource(const StudyFacts &study, const VolumeFacts &volume,
                          const std::vector<dicom::InstanceFile> &files) {
    StudySource source;
    source.study = study;
    source.volume = volume;
    for (const dicom::InstanceFile &file : files)
        source.files << QString::fromStdString(file.path.string());
    source.lasting = source.files;
    source.load = [volume, files](const task::Progress &progress,
                                  const dicom::LoadObserver &observer) {
        return loadFromLibrary(volume, files, progress, observer);
    };
    return source;
}

StudySource phantomSource(const QString &name) {
    const phantom::Kind kind = phantom::kindFromName(name.toStdString());
    const volume::Lattice lattice = phantom::phantomLattice(kind, {});
    StudySource source;
    source.phantom = name;
    source.study.origin = Origin::phantom;
    source.study.patientId = "phantoms";
    source.study.patientName = "Phantoms"; // patientText() translates it
    source.study.description = StudySourceTexts::tr("Made by Pellucid");
    source.volume.seriesUid = name;
    source.volume.seriesNumber = name == "head" ? 1 : 2;
    source.volume.description = name == "head"    ? StudySourceTexts::tr("Head phantom")
                                : name == "chest" ? StudySourceTexts::tr("Chest phantom")
                                                  : name;
    source.volume.size = lattice.size();
    source.volume.spacingMm = {lattice.spacingMm(0), lattice.spacingMm(1),
                               lattice.sliceDistanceMm()};
    source.load = [kind, lattice](const task::Progress &progress, const dicom::LoadObserver &) {
        return dicom::LoadedVolume{phantom::makePhantom(kind, lattice, progress), {}};
    };
    source.makeThumbnail = [kind] {
        return makeThumbnail(phantom::makePhantom(
            kind, phantom::phantomLattice(kind, {.size = thumbnailPhantom}), {}));
    };
    return source;
}

} // namespace pellucid::ui
