// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <QString>

#include "core/dicom/catalogue.h"
#include "core/dicom/load_volume.h"
#include "ui/studies/study_facts.h"

namespace pellucid::ui {

/// Something that can be shown: a volume of a study with the way to load it. A value.
struct StudySource {
    StudyFacts study;
    VolumeFacts volume;
    /// Of its series; a phantom has a name instead.
    QStringList files;
    QString phantom;
    /// Where they are when the program has ended, too: of an archive, the archive.
    QStringList lasting;
    /// Thread-safe; see dicom::loadVolume.
    std::function<dicom::LoadedVolume(const task::Progress &, const dicom::LoadObserver &)> load;
    /// Thread-safe; for volumes whose facts have none.
    std::function<QImage()> makeThumbnail;
    /// The user has closed it: not listed any more.
    bool isClosed = false;

    /// The file, or the folder of its files, that is named where something about it is said; a
    /// phantom has none.
    QString place() const;
    /// What tells it from every other.
    QString key() const { return study.key() + "\n" + volume.key(); }
    /// The same without names in it, for files.
    QString digest() const;
};

/// One source per volume of a catalogue.
std::vector<StudySource> sourcesFrom(const std::shared_ptr<const dicom::Catalogue> &catalogue);

/// The index of the source that a user most likely wants: the volume with most voxels.
std::size_t defaultSource(const dicom::Catalogue &catalogue);

/// A volume of the library, by the files of its series: they are looked at again when it is loaded.
StudySource librarySource(const StudyFacts &study, const VolumeFacts &volume,
                          const std::vector<dicom::InstanceFile> &files);

/// A built-in phantom by its name, see core/phantom.
StudySource phantomSource(const QString &kind);

} // namespace pellucid::ui
