// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <QObject>
#include <QStringList>

#include "core/dicom/catalogue.h"
#include "core/segment/segment_set.h"
#include "core/task/progress.h"

namespace pellucid::ui {

class Document;
class JobRunner;
class LookPreparer;

/// Segments from files, and the files that could not be used, with reasons and warnings.
struct LoadedSegments {
    std::shared_ptr<const segment::SegmentSet> set; ///< null if nothing was loaded
    std::vector<dicom::Skipped> problems;
};

/// Loads the segments of files for a volume, in addition to those of a set, which may be null. A
/// file that cannot be used is a problem. *Throws* Cancelled.
LoadedSegments loadSegments(const QStringList &paths, const volume::Volume &volume,
                            std::shared_ptr<const segment::SegmentSet> present,
                            const task::Progress &progress);

/// Opens files of segments for the open volume, as jobs: their segments become classes of the look.
/// Meanwhile no projection is prepared, which would stop the job.
class SegmentOpener : public QObject {
    Q_OBJECT
public:
    SegmentOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                  QObject *parent = nullptr);

    /// Does nothing unless a volume is open.
    void open(const QStringList &paths);

private:
    void show(const LoadedSegments &loaded);

    Document &m_document;
    JobRunner &m_jobs;
    LookPreparer &m_preparer;
};

} // namespace pellucid::ui
