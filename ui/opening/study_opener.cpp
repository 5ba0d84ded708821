// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/study_opener.h"

#include <filesystem>
#include <utility>

#include "core/classify/couch.h"
#include "core/decoding/client/reasons.h"
#include "core/dicom/reasons.h"
#include "core/dicom/scan.h"
#include "core/preprocess/study_content.h"
#include "core/system/log.h"
#include "core/system/memory.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/engine/look_preparer.h"
#include "ui/jobs/job_runner.h"
#include "ui/language/reasons.h"
#include "ui/opening/reasons.h"
#include "ui/opening/segment_opener.h"
#include "ui/studies/difference_source.h"
#include "ui/studies/reasons.h"
#include "ui/studies/study_source.h"
#include "ui/studies/window_presets.h"

namespace pellucid::ui {

namespace {

// Without those in archives, whose unpacked files are gone with the catalogue.
QStringList segmentationsIn(const dicom::Catalogue &catalogue) {
    QStringList paths;
    for (const dicom::Skipped &file : catalogue.skipped)
        if (std::error_code unknown; file.reason.is(task::because::isASegmentation) &&
                                     std::filesystem::is_regular_file(file.path, unknown))
            paths << QString::fromStdString(file.path.string());
    return paths;
}

// A study opens even if this fails, for lack of memory for example.
preprocess::StudyContent contentOf(const volume::Volume &volume, const task::Progress &progress) {
    try {
        return preprocess::contentOf(volume, progress);
    } catch (const task::Error &error) {
        system::log(std::string("what the study shows is unknown: ") + error.what());
        return {};
    }
}

} // namespace

StudyOpener::StudyOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                         QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs), m_preparer(preparer) {
    // Queued: the code that ended the job may start the next one.
    connect(&jobs, &JobRunner::finished, this, &StudyOpener::returnToFormer, Qt::QueuedConnection);
}

void StudyOpener::returnToFormer() {
    if (m_jobs.isRunning()) // another study is being opened, and may fail as well
        return;
    const auto former = std::exchange(m_former, std::nullopt);
    const bool isLoaded = m_document.volume() && !m_document.isPreview();
    // Only if it comes back without a job: the load may have failed for lack of memory.
    if (former && !isLoaded && m_kept.isReady(*former))
        openSource(*former);
}

void StudyOpener::keepCurrent() {
    const auto &volume = m_document.volume();
    if (!volume || m_document.isPreview() || m_document.currentSource() < 0)
        return;
    m_kept.keep({m_document.currentSource(),
                 {*volume, m_document.initialWindow(), m_document.defaultFieldWindow()},
                 m_document.view(),
                 m_preparer.preparedFor(),
                 m_preparer.fullEngine()});
    // The next study may need half of the memory.
    m_kept.trim(system::availableMemoryBytes() / 2 + m_kept.bytes() / 2);
}

void StudyOpener::take(StudyView &view, const StudyView &wanted) {
    const presets::StudyTraits traits = view.traits;
    const auto segments = view.segments;
    view = wanted;
    view.traits = traits;
    view.segments = wanted.segments && wanted.segments->lattice() == m_document.volume()->lattice()
                        ? wanted.segments
                        : segments;
    const QStringList missing = missingSegments(view.scene.look, view.segments.get());
    if (missing.isEmpty())
        return;
    m_document.addProblems({{m_document.place().toStdString(),
                             task::because::sceneNeedsSegments(missing.join(", ").toStdString())}});
    dropMissing(view.scene.look, view.segments.get());
}

void StudyOpener::show(const KeptStudy &study, const std::function<void(StudyView &)> &adjust) {
    m_document.show(study.opened, [&](StudyView &view) {
        const scene::Scene before = view.scene;
        view = study.view;
        // The quality of pictures is the user's choice, not a property of the study.
        view.scene.tolerance = before.tolerance;
        view.scene.interpolation = before.interpolation;
        if (adjust)
            adjust(view);
    });
    if (study.engine)
        m_preparer.adopt(*study.preparedFor, *study.engine);
    m_preparer.prepareAgain(); // if the quality changed or the engine was dropped
}

void StudyOpener::openPaths(const QStringList &paths, const std::optional<Resumption> &resumption,
                            const dicom::ScanOptions &options) {
    if (paths.isEmpty())
        return;
    m_resumption = resumption;
    std::vector<std::filesystem::path> files;
    for (const QString &path : paths)
        files.emplace_back(path.toStdString());
    m_jobs.start(
        tr("Reading headers"),
        [this, files, paths, options](const Job &job) {
            auto catalogue = std::make_shared<const dicom::Catalogue>(
                dicom::scan(files, job.progress(), options));
            job.deliver([this, catalogue, files, paths] {
                std::vector<dicom::Skipped> problems = dicom::problemsOf(*catalogue);
                if (catalogue->empty() && m_document.volume()) { // they are opened for it
                    const QStringList opened = segmentationsIn(*catalogue);
                    std::erase_if(problems, [&](const dicom::Skipped &s) {
                        return opened.contains(QString::fromStdString(s.path.string()));
                    });
                }
                m_document.addProblems(problems);
                std::vector<dicom::Skipped> huge = catalogue->skipped;
                std::erase_if(huge, [](const dicom::Skipped &s) { return !s.isHuge; });
                if (!huge.empty())
                    emit hugeFound(paths, huge);
                if (catalogue->empty()) {
                    const QStringList segmentations = segmentationsIn(*catalogue);
                    if (!segmentations.isEmpty() && m_document.volume())
                        emit segmentationsFound(segmentations);
                    else if (catalogue->skipped.empty())
                        m_document.addProblems({{files.front(), task::because::holdsNoImages}});
                    return;
                }
                const auto indices = m_document.addSources(sourcesFrom(catalogue));
                // Files may have changed since.
                for (const int index : indices)
                    m_kept.take(index);
                const auto resumed = resumedOf(indices);
                if (!m_resumption) // the paths of a session were opened before
                    emit pathsOpened(paths);
                else if (!resumed)
                    m_document.addProblems({{files.front(), task::because::isAnotherStudy}});
                openSource(resumed.value_or(indices[defaultSource(*catalogue)]));
            });
        },
        {}, paths.front());
    m_preparer.awaitJob();
}

std::optional<int> StudyOpener::resumedOf(const std::vector<int> &indices) {
    if (!m_resumption)
        return std::nullopt;
    const auto with = [&](const QString &digest) -> std::optional<int> {
        for (const int index : indices)
            if (m_document.sources()[std::size_t(index)].digest() == digest)
                return index;
        return std::nullopt;
    };
    const auto &difference = m_resumption->difference;
    if (!difference)
        return with(m_resumption->digest);
    const auto minuend = with(difference->minuend), subtrahend = with(difference->subtrahend);
    if (!minuend || !subtrahend)
        return std::nullopt;
    // Copies: adding a source moves the others.
    const StudySource from = m_document.sources()[std::size_t(*minuend)];
    const StudySource what = m_document.sources()[std::size_t(*subtrahend)];
    return addDifference(from, what,
                         difference->isAligned ? std::make_shared<Alignment>() : nullptr);
}

int StudyOpener::addDifference(const StudySource &minuend, const StudySource &subtrahend,
                               const std::shared_ptr<Alignment> &alignment) {
    // From the thread that loads. The jobs end before the opener does.
    const auto rename = [this](const QString &key, const QString &description) {
        QMetaObject::invokeMethod(this, [this, key, description] {
            const int index = m_document.sourceWith(key);
            if (index < 0 || m_document.sources()[std::size_t(index)].isClosed)
                return;
            StudySource renamed = m_document.sources()[std::size_t(index)];
            renamed.volume.description = description;
            m_document.addSources({renamed});
        });
    };
    const StudySource source = differenceSource(minuend, subtrahend, alignment, rename);
    const int present = m_document.sourceWith(source.key());
    if (present >= 0 && !m_document.sources()[std::size_t(present)].isClosed)
        return present; // with what was found when it was loaded
    return m_document.addSources({source}).front();
}

void StudyOpener::openDifference(const StudySource &subtrahend,
                                 const std::shared_ptr<Alignment> &alignment) {
    const int open = m_document.currentSource();
    if (open < 0 || !m_document.volume() || m_document.isPreview())
        return;
    const StudySource minuend = m_document.sources()[std::size_t(open)];
    const int index = addDifference(minuend, subtrahend, alignment);
    openSource(index, [this, index](const Outcome &) {
        if (m_document.currentSource() != index) // it cannot be made, or was given up
            m_document.closeSource(index);
    });
}

void StudyOpener::resume(StudyView &view) {
    const auto resumption = std::exchange(m_resumption, std::nullopt);
    if (!resumption || m_document.currentSource() < 0)
        return;
    const StudySource &open = m_document.sources()[std::size_t(m_document.currentSource())];
    if (open.digest() != resumption->digest)
        return;
    m_document.addProblems(resumption->leftOut);
    take(view, resumption->view);
}

void StudyOpener::openPhantom(const QString &kind, const std::optional<Resumption> &resumption) {
    m_resumption = resumption;
    openSource(m_document.addSources({phantomSource(kind)}).front());
}

void StudyOpener::openFromLibrary(const StudyFacts &study, const std::vector<VolumeFacts> &series,
                                  const QString &volume,
                                  const std::vector<dicom::InstanceFile> &files) {
    std::vector<StudySource> sources;
    for (const VolumeFacts &v : series)
        sources.push_back(librarySource(study, v, files));
    const auto indices = m_document.addSources(sources);
    for (std::size_t n = 0; n < series.size(); ++n)
        if (series[n].key() == volume)
            openSource(indices[n]);
}

void StudyOpener::closeSource(int index) {
    m_kept.take(index);
    if (index == m_document.currentSource()) {
        m_jobs.cancel();
        m_preparer.forgetVolume();
        m_document.closeVolume();
        m_document.setCurrentSource(-1);
    }
    m_document.closeSource(index);
}

StudyView StudyOpener::leavePhase(int next) {
    StudyView stays = m_document.view();
    const auto exposure = m_document.exposure();
    // A volume's own window would differ from phase to phase.
    if (!volume::isCalibrated(m_document.volume()->unit()))
        stays.scene.fieldWindow = m_document.fieldWindow();
    stays.exposure.reset();
    if (exposure)
        stays.exposure = {*exposure, picture::ToneSubject(stays.scene)};
    keepCurrent();
    m_preparer.forgetVolume();
    m_document.setCurrentSource(next);
    emit phaseLeft();
    return stays;
}

void StudyOpener::continuePhase(StudyView &view, const StudyView &former) {
    take(view, former);
    view.pose = m_document.poseOf(former.scene.camera);
    view.pose.isFitted = former.pose.isFitted;
}

void StudyOpener::openPhase(int index, JobRunner::OnEnd onEnd) {
    if (!m_document.volume() || m_document.isPreview()) {
        openSource(index, std::move(onEnd));
        return;
    }
    m_jobs.cancel();
    // Taken first: keeping the former phase may drop another one.
    if (const auto kept = m_kept.take(index)) {
        const StudyView stays = leavePhase(index);
        show(*kept, [&](StudyView &view) { continuePhase(view, stays); });
        return;
    }
    // The former phase stays until this one is loaded.
    const StudySource source = m_document.sources().at(std::size_t(index));
    scene::Scene scene = m_document.scene();
    if (!volume::isCalibrated(m_document.volume()->unit()))
        scene.fieldWindow = m_document.fieldWindow();
    const PreparedFor wanted(scene);
    m_jobs.start(
        tr("Loading %1").arg(seriesText(source.volume)),
        [this, source, index, wanted, lattice = m_document.volume()->lattice(),
         hasSegments = m_document.segments() != nullptr,
         prepare = m_preparer.preparation(wanted, 0.6, prepare::Detail::full)](const Job &job) {
            const dicom::LoadedVolume loaded = source.load(job.progress().part(0.0, 0.6), {});
            const volume::ValueWindow window = initialWindow(loaded.volume);
            const auto field = classify::defaultFieldWindow(loaded.volume);
            const auto open = [this, loaded, window, field, index] {
                const StudyView stays = leavePhase(index);
                m_document.addProblems(loaded.skipped);
                m_document.show({loaded.volume, window, field},
                                [&](StudyView &view) { continuePhase(view, stays); });
            };
            // Segments of this phase are not on the lattice of another.
            if (hasSegments && !(loaded.volume.lattice() == lattice)) {
                job.deliver([this, open] {
                    open();
                    m_preparer.prepareAgain();
                });
                return;
            }
            job.deliver([this, open, wanted] {
                open();
                m_preparer.expect(wanted);
                m_preparer.prepareAgain(); // the look may have changed meanwhile
            });
            job.stage(tr("Preparing the projection"));
            prepare(job, loaded.volume);
        },
        [this, onEnd = std::move(onEnd)](const Outcome &outcome) {
            m_preparer.jobEnded(outcome);
            if (onEnd)
                onEnd(outcome);
        },
        source.place());
}

PreparedFor StudyOpener::leaveFor(int index) {
    // First: the end of the former job changes the document.
    m_jobs.cancel();
    keepCurrent();
    if (m_document.volume() && !m_document.isPreview() && m_document.currentSource() >= 0)
        m_former = m_document.currentSource();
    const PreparedFor wanted = m_preparer.forgetVolume();
    m_document.setCurrentSource(index);
    m_document.closeVolume();
    return wanted;
}

void StudyOpener::openSource(int index, JobRunner::OnEnd onEnd) {
    // It is open, or being opened.
    if (index == m_document.currentSource() && (m_document.volume() || m_jobs.isRunning())) {
        if (m_document.volume())
            m_preparer.prepareAgain(); // a scan may have stopped it
        return;
    }
    const StudySource source = m_document.sources().at(std::size_t(index));
    const PreparedFor wanted = leaveFor(index);
    if (const auto kept = m_kept.take(index)) {
        m_former.reset(); // it cannot fail
        show(*kept, {});
        return;
    }
    m_preparer.expect(wanted);
    m_jobs.start(
        tr("Loading %1").arg(seriesText(source.volume)), loading(source, wanted),
        [this, onEnd = std::move(onEnd)](const Outcome &outcome) {
            m_preparer.jobEnded(outcome);
            // After a load that delivered no volume, nothing is open.
            if (!m_document.volume())
                m_document.setCurrentSource(-1);
            if (onEnd)
                onEnd(outcome);
        },
        source.place());
}

JobRunner::Work StudyOpener::loading(const StudySource &source, const PreparedFor &wanted) {
    QStringList segmentations;
    if (m_resumption && source.digest() == m_resumption->digest)
        segmentations = m_resumption->segmentations;
    return [this, source, finish = finishing(segmentations, wanted)](const Job &job) {
        dicom::LoadObserver observer;
        observer.preview = [&](const volume::Volume &soFar) {
            const volume::ValueWindow window = initialWindow(soFar);
            job.deliver([this, soFar, window] { m_document.show({soFar, window, {}, true}); });
        };
        finish(job, source.load(job.progress().part(0.0, 0.6), observer));
    };
}

StudyOpener::Finish StudyOpener::finishing(const QStringList &segmentations,
                                           const PreparedFor &wanted) {
    // What is shown at first of a study that has a couch.
    PreparedFor bare = wanted;
    classify::removeCouch(bare.look, classify::ctFieldWindow);
    return [this, segmentations, bare,
            prepareBare = m_preparer.preparation(bare, 0.6, prepare::Detail::coarse),
            prepare = m_preparer.preparation(wanted, 0.6, prepare::Detail::coarse)](
               const Job &job, const dicom::LoadedVolume &loaded) {
        const volume::Volume volume = loaded.volume;
        const volume::ValueWindow window = initialWindow(volume);
        const classify::FieldWindow field = classify::defaultFieldWindow(volume);
        const LoadedSegments segments =
            loadSegments(segmentations, volume, nullptr, job.progress().part(0.6, 0.6));
        const preprocess::StudyContent content = contentOf(volume, job.progress().part(0.6, 0.6));
        job.deliver([this, loaded, window, field, segments, bare, content] {
            m_document.addProblems(loaded.skipped);
            m_document.addProblems(segments.problems);
            m_document.show({loaded.volume, window, field}, [&](StudyView &view) {
                view.traits = content.traits;
                if (content.hasCouch && view.scene.look == classify::Look()) {
                    view.scene.look = bare.look;
                    m_preparer.expect(bare);
                }
                view.segments = segments.set;
                resume(view);
            });
            // The quality may have changed during the load.
            m_preparer.prepareAgain();
        });
        if (!volume.notes().placed) {
            job.deliver([this, volume] {
                const auto &warnings = volume.notes().warnings;
                emit notProjectable(warnings.empty() ? tr("images only")
                                                     : translated(warnings.back()));
            });
            return;
        }
        job.stage(tr("Preparing the projection"));
        (content.hasCouch ? prepareBare : prepare)(job, volume);
    };
}

void StudyOpener::openArriving(const StudyFacts &study,
                               const std::shared_ptr<dicom::ArrivingSeries> &series) {
    // It stands for the series until the files say which it is.
    StudySource source;
    source.study = study;
    source.volume.description = tr("Arriving");
    source.load = [](const task::Progress &, const dicom::LoadObserver &) -> dicom::LoadedVolume {
        throw task::Error(task::ErrorCode::unusable, task::because::seriesIsGone);
    };
    const int index = m_document.addSources({source}).front();
    const PreparedFor wanted = leaveFor(index);
    m_preparer.expect(wanted);
    m_jobs.start(
        tr("Waiting for the first slices"),
        [this, series, index, finish = finishing({}, wanted),
         project = m_preparer.partialPreparation(wanted)](const Job &job) {
            const auto show = [&](const dicom::PartialVolume &partial,
                                  const task::Progress &progress) {
                const volume::Volume &soFar = partial.volume;
                job.stage(
                    tr("%1 of %2 slices")
                        .arg(QString::number(partial.slices), QString::number(partial.count)));
                job.deliver([this, soFar, window = initialWindow(soFar)] {
                    m_document.show({soFar, window, classify::defaultFieldWindow(soFar), true});
                });
                // As fine as the slices allow, in a part of the time until the next ones.
                if (partial.stride <= 8)
                    project(job, soFar,
                            partial.stride <= 2   ? 192
                            : partial.stride <= 4 ? 128
                                                  : 96,
                            progress);
            };
            const dicom::ArrivedSeries arrived = series->load(job.progress().part(0.0, 0.6), show);
            job.deliver([this, index, catalogue = arrived.catalogue] {
                m_document.addProblems(dicom::problemsOf(*catalogue));
                const auto indices = m_document.addSources(sourcesFrom(catalogue));
                for (const int known : indices) // it may have had fewer files
                    m_kept.take(known);
                m_document.setCurrentSource(indices[defaultSource(*catalogue)]);
                m_document.closeSource(index);
            });
            finish(job, arrived.loaded);
        },
        [this, index](const Outcome &outcome) {
            m_preparer.jobEnded(outcome);
            // A part of a series does not stay.
            if (m_document.currentSource() == index) {
                m_document.closeVolume();
                m_document.setCurrentSource(-1);
            }
            if (!m_document.sources()[std::size_t(index)].isClosed)
                m_document.closeSource(index);
        },
        {});
}

} // namespace pellucid::ui
