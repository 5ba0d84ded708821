// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QString>
#include <QStringList>

#include "core/task/progress.h"

namespace pellucid::ui {

class Document;

/// Writes segments; may run on any thread. Returns the names of the classes that have no sample in
/// the file. *Throws* task::Error, task::Cancelled.
using SegmentWriter = std::function<QStringList(const task::Progress &)>;

/// A writer of the shown classes: a DICOM segmentation of the study (`.dcm`), or labels that 3D
/// Slicer reads (`.nrrd`), which cannot overlap. The file appears only when complete. *Requires*: a
/// volume is open. *Throws* Error{usage} if a file of an open study would be replaced.
SegmentWriter segmentWriter(const Document &document, const QString &path);

} // namespace pellucid::ui
