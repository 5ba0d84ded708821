// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <QObject>
#include <QStringList>

#include "core/dicom/arriving_series.h"
#include "core/dicom/scan.h"
#include "ui/document/document.h"
#include "ui/jobs/job_runner.h"
#include "ui/opening/kept_studies.h"
#include "ui/studies/difference_source.h"
#include "ui/studies/study_source.h"

namespace pellucid::ui {

/// Opens studies, as jobs: scans paths, chooses a volume, loads it with previews, and has its
/// projection prepared. Former studies are kept as long as memory allows.
class StudyOpener : public QObject {
    Q_OBJECT
public:
    StudyOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                QObject *parent = nullptr);

    /// How to look at a certain source when it is opened.
    struct Resumption {
        QString digest; ///< of the source
        StudyView view;
        /// Other files of its folders that could not be used then.
        std::vector<dicom::Skipped> leftOut;
        /// Files of segments to load for it.
        QStringList segmentations;
        /// Set if the source is a difference, which is made again.
        std::optional<DifferenceOf> difference = {};
    };
    void openPaths(const QStringList &paths, const std::optional<Resumption> &resumption = {},
                   const dicom::ScanOptions &options = {});
    void openPhantom(const QString &kind, const std::optional<Resumption> &resumption = {});
    /// Opens a source, unless it is open already. `onEnd` is called if the volume has to be loaded.
    void openSource(int index, JobRunner::OnEnd onEnd = {});
    /// Opens the difference between the open volume and another one, which becomes a source of its
    /// own. Does nothing if no volume is open.
    void openDifference(const StudySource &subtrahend, const std::shared_ptr<Alignment> &alignment);
    /// Opens another volume of the same series: look, view, window, crosshair and planes stay, and
    /// so does the former volume until the new one is loaded. `onEnd`: as in `openSource`.
    void openPhase(int index, JobRunner::OnEnd onEnd = {});
    /// Opens a volume of the library. *Shape*: `series`: all volumes of its series; `volume`: the
    /// key of the one to open.
    void openFromLibrary(const StudyFacts &study, const std::vector<VolumeFacts> &series,
                         const QString &volume, const std::vector<dicom::InstanceFile> &files);
    /// Opens a series while it arrives: what is there is a preview, also in the projection.
    void openArriving(const StudyFacts &study,
                      const std::shared_ptr<dicom::ArrivingSeries> &series);
    /// Takes a source off the list, and closes it if it is open.
    void closeSource(int index);

signals:
    /// The paths contain no images, but segmentations, which may belong to the open volume.
    void segmentationsFound(const QStringList &paths);
    /// The paths contain a study that can be opened.
    void pathsOpened(const QStringList &paths);
    /// They contain images so large that they are opened only if the user asks for it.
    void hugeFound(const QStringList &paths, const std::vector<pellucid::dicom::Skipped> &huge);
    /// Another phase follows: the exposure of the projection has to stay.
    void phaseLeft();
    /// The open volume cannot be projected.
    void notProjectable(const QString &reason);

private:
    /// The work that loads a volume and prepares its projection.
    JobRunner::Work loading(const StudySource &source, const PreparedFor &wanted);
    /// What follows when the volume is loaded.
    using Finish = std::function<void(const Job &, const dicom::LoadedVolume &)>;
    Finish finishing(const QStringList &segmentations, const PreparedFor &wanted);
    /// Leaves what is open for another source, and returns what its projection is made for.
    PreparedFor leaveFor(int index);
    /// The source among them that is to be resumed, or their difference.
    std::optional<int> resumedOf(const std::vector<int> &indices);
    int addDifference(const StudySource &minuend, const StudySource &subtrahend,
                      const std::shared_ptr<Alignment> &alignment);
    /// Gives the view of a study that has been loaded the values with which it is resumed.
    void resume(StudyView &view);
    void keepCurrent();
    /// Reopens the previous study after a load that failed or was cancelled.
    void returnToFormer();
    /// Leaves a phase for another, and returns how it was looked at.
    StudyView leavePhase(int next);
    /// Looks at the volume as at the former phase, at the same pixel size.
    void continuePhase(StudyView &view, const StudyView &former);
    /// Sets the view, but not what the volume shows, without classes whose segments are not loaded.
    void take(StudyView &view, const StudyView &wanted);
    void show(const KeptStudy &study, const std::function<void(StudyView &)> &adjust);

    Document &m_document;
    JobRunner &m_jobs;
    LookPreparer &m_preparer;
    KeptStudies m_kept;
    std::optional<int> m_former; ///< the source shown before the current load
    std::optional<Resumption> m_resumption;
};

} // namespace pellucid::ui
