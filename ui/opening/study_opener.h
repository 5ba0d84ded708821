// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <QObject>
#include <QStringList>

#include "core/dicom/scan.h"
#include "ui/document/document.h"
#include "ui/jobs/job_runner.h"
#include "ui/opening/kept_studies.h"
#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// How a volume is looked at, as far as it holds for another one too.
struct Continuity {
    scene::Scene scene;
    volume::ValueWindow displayWindow;
    volume::PatientPoint crosshair;
    Cut cut;
    std::optional<picture::ToneRange> brightness; ///< see Document
};

/// The way from a path to a turning picture, as jobs: scan, choose, load with previews, and have
/// the projection prepared.
class StudyOpener : public QObject {
    Q_OBJECT
public:
    StudyOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                QObject *parent = nullptr);

    /// How what is opened is to be looked at, if it is that source.
    struct Resumption {
        QString digest; ///< of the source
        Continuity shown;
        /// What else of its folders could not be used then.
        std::vector<dicom::Skipped> leftOut;
    };
    void openPaths(const QStringList &paths, const std::optional<Resumption> &resumption = {},
                   const dicom::ScanOptions &options = {});
    void openPhantom(const QString &kind, const std::optional<Resumption> &resumption = {});
    /// `onEnd` is called if the volume has to be loaded.
    void openSource(int index, JobRunner::OnEnd onEnd = {});
    /// Another volume of the same series: look, view, window, crosshair and planes stay. `onEnd` is
    /// called if the volume has to be loaded; the former one stays until it is there.
    void openPhase(int index, JobRunner::OnEnd onEnd = {});
    /// *Shape*: `series`: all volumes of it; `volume`: the one that is opened.
    void openFromLibrary(const StudyFacts &study, const std::vector<VolumeFacts> &series,
                         const QString &volume, const std::vector<dicom::InstanceFile> &files);
    /// Takes it off the list; if it is the open one, nothing is open then.
    void closeSource(int index);

signals:
    /// The paths held something.
    void pathsOpened(const QStringList &paths);
    /// They held images that are opened only when that is asked for.
    void hugeFound(const QStringList &paths, const std::vector<pellucid::dicom::Skipped> &huge);
    /// The way the study that came back was looked at.
    void cameraKept(const pellucid::scene::Camera &camera);
    void brightnessKept(const pellucid::picture::ToneRange &range);
    /// The brightness of the projection is to stay, too.
    void phaseLeft();
    /// The open volume cannot be projected.
    void notProjectable(const QString &reason);

private:
    /// The work that loads a volume and prepares its projection.
    JobRunner::Work loading(const StudySource &source, const PreparedFor &wanted);
    /// Lets the preparer go on.
    void endScan();
    /// The one of them that is to be resumed.
    std::optional<int> resumedOf(const std::vector<int> &indices) const;
    void applyResumption();
    void keepCurrent();
    /// Reopens the previous study after a load that failed or was cancelled.
    void goBack();
    Continuity leavePhase(int next);
    void resume(const Continuity &continuity);
    void show(const KeptStudy &study, const std::optional<Continuity> &continuity);

    Document &m_document;
    JobRunner &m_jobs;
    LookPreparer &m_preparer;
    KeptStudies m_kept;
    std::optional<int> m_former; ///< the source shown before the current load
    std::optional<Resumption> m_resumption;
};

} // namespace pellucid::ui
