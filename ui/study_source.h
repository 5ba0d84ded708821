// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <QString>
#include <QStringList>

#include "core/dicom/catalogue.h"
#include "core/dicom/load_volume.h"

namespace pellucid::ui {

/// Something that can be shown: a volume of a study with the way to load it. A value; the names it
/// carries are for the eye only and go into no log, no title and no file name.
struct StudySource {
    QString patient, study, series, detail;
    /// What tells patients, studies and volumes apart; never the names, which may be equal.
    QString patientKey, studyKey, key;
    QStringList warnings;
    bool placed = true;
    /// Thread-safe; see dicom::loadVolume.
    std::function<dicom::LoadedVolume(const task::Progress &, const dicom::LoadObserver &)> load;
};

/// One source per volume of a catalogue.
std::vector<StudySource> sourcesFrom(const std::shared_ptr<const dicom::Catalogue> &catalogue);

/// The index of the source that a user most likely wants: the volume with most voxels.
std::size_t defaultSource(const dicom::Catalogue &catalogue);

/// A built-in phantom by its name, see core/phantom.
StudySource phantomSource(const QString &kind);

} // namespace pellucid::ui
