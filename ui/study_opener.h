// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QStringList>

#include "ui/kept_studies.h"
#include "ui/study_source.h"

namespace pellucid::ui {

class Document;
class JobRunner;

/// The way from a path to a turning picture, as jobs: scan, choose, load with previews, and have
/// the projection prepared.
class StudyOpener : public QObject {
    Q_OBJECT
public:
    StudyOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                QObject *parent = nullptr);

    void openPaths(const QStringList &paths);
    void openPhantom(const QString &kind);
    void openSource(int index);
    void openFromLibrary(const StudyFacts &study, const VolumeFacts &volume,
                         const std::vector<dicom::InstanceFile> &files);
    /// Takes it off the list; if it is the open one, nothing is open then.
    void closeSource(int index);

signals:
    /// The paths held something.
    void pathsOpened(const QStringList &paths);
    /// The way the study that came back was looked at.
    void cameraKept(const pellucid::render::Camera &camera);
    /// The open volume cannot be projected.
    void notProjectable(const QString &reason);

private:
    void endScan();
    void keepCurrent();
    bool showKept(int index);

    Document &m_document;
    JobRunner &m_jobs;
    LookPreparer &m_preparer;
    KeptStudies m_kept;
};

} // namespace pellucid::ui
