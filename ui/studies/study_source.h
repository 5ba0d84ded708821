// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <QString>

#include "core/dicom/catalogue.h"
#include "core/dicom/load_volume.h"
#include "core/subtraction/difference.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// The sources of a difference, by their digests.
struct DifferenceOf {
    QString minuend, subtrahend;
    bool isAligned = false;
};

/// A volume that can be shown: its facts and how to load it. A value.
struct StudySource {
    StudyFacts study;
    VolumeFacts volume;
    /// The files of its series; a phantom has a name instead.
    QStringList files;
    /// The file of each slice, in their order; empty if slices are interpolated or not known yet.
    QStringList slices;
    QString phantom;
    /// The paths that still exist after the program ends: for files in an archive, the archive.
    QStringList lasting;
    /// Segmentations of its study: paths and titles.
    std::vector<std::pair<QString, QString>> segmentations;
    /// Set for a difference of two volumes.
    std::optional<DifferenceOf> difference;
    /// Thread-safe; see dicom::loadVolume.
    std::function<dicom::LoadedVolume(const task::Progress &, const dicom::LoadObserver &)> load;
    /// Thread-safe; for volumes whose facts have no thumbnail.
    std::function<QImage()> makeThumbnail;
    /// The user has closed it, so it is no longer listed.
    bool isClosed = false;

    /// The file or folder that messages about it name; empty for a phantom.
    QString place() const;
    /// Distinguishes it from every other source.
    QString key() const { return study.key() + "\n" + volume.key(); }
    /// A hash of the key that reveals no names, for file names.
    QString digest() const;
};

/// One source per volume of a catalogue.
std::vector<StudySource> sourcesFrom(const std::shared_ptr<const dicom::Catalogue> &catalogue);

/// The index of the source to open first: the volume with the most voxels.
std::size_t defaultSource(const dicom::Catalogue &catalogue);

/// A volume of the library, given by the files of its series. Loading scans them again.
StudySource librarySource(const StudyFacts &study, const VolumeFacts &volume,
                          const std::vector<dicom::InstanceFile> &files);

/// A built-in phantom by its name, see core/phantom.
StudySource phantomSource(const QString &kind);

} // namespace pellucid::ui
