// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study_opener.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/classify/coarse_field.h"
#include "core/classify/shown_fields.h"
#include "core/dicom/scan.h"
#include "core/task/memory.h"
#include "ui/document.h"
#include "ui/job_runner.h"
#include "ui/study_source.h"
#include "ui/window_presets.h"

namespace pellucid::ui {

namespace {

// The coarse projection: small enough to be there within a blink of the volume.
constexpr int coarseSide = 96;

} // namespace

StudyOpener::StudyOpener(Document &document, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs) {
    connect(&document, &Document::sceneChanged, this, &StudyOpener::followScene);
    // Done or cancelled: what was not delivered is not there.
    connect(&jobs, &JobRunner::finished, this, [this] {
        m_scanning = false;
        if (m_underway)
            m_givenUp = std::exchange(m_underway, std::nullopt);
    });
}

void StudyOpener::prepareAgain() {
    m_givenUp.reset();
    followScene();
}

void StudyOpener::followScene() {
    const Prepared wanted(m_document.scene());
    const auto &volume = m_document.volume();
    if (!volume || m_document.isPreview() || !volume->notes().placed || m_scanning ||
        wanted == m_underway || wanted == m_givenUp)
        return;
    if (wanted == m_prepared) {
        // Back to what is shown: nothing else is wanted any more.
        if (m_underway)
            m_jobs.cancel();
        return;
    }
    startPreparing();
}

void StudyOpener::startPreparing() {
    const Prepared wanted(m_document.scene());
    // The picture of another field is wrong, that of another quality is still a picture.
    const bool coarseFirst =
        !m_prepared || !(wanted.window == m_prepared->window) || !(wanted.look == m_prepared->look);
    m_jobs.start(tr("Preparing the projection"),
                 [this, volume = *m_document.volume(), wanted, coarseFirst](const Job &job) {
                     prepare(job, volume, wanted, 0.0, coarseFirst);
                 });
    // Now that the end of the former job has been told.
    m_underway = wanted;
    m_givenUp.reset();
}

void StudyOpener::prepare(const Job &job, const volume::Volume &volume, const Prepared &wanted,
                          double from, bool coarseFirst) {
    const task::Progress progress = job.progress().part(from, 1.0);
    // Planned for the whole volume in a picture of its own; the pane's zoom comes and goes.
    render::Scene scene;
    scene.tolerance = wanted.tolerance;
    scene.interpolation = wanted.interpolation;
    scene.camera.pixelMm = volume.lattice().shortestStepMm();
    scene.camera.width = scene.camera.height =
        int(std::clamp(2.0 * volume.lattice().radiusMm() / scene.camera.pixelMm, 2.0, 4096.0));
    const auto fields =
        classify::shownFields(volume, wanted.window.value_or(classify::defaultFieldWindow(volume)),
                              wanted.look, nullptr, progress.part(0.0, 0.1));
    const auto announce = [&](const classify::ShownFields &f, bool coarse,
                              const task::Progress &p) {
        const auto prepared = render::prepareEngine(scene, f, {task::availableMemoryBytes()}, p);
        job.deliver([this, prepared, coarse, wanted] {
            // A coarse picture leaves the full one wanted.
            if (!coarse) {
                m_prepared = wanted;
                m_underway.reset();
                m_givenUp.reset();
            }
            emit engineReady(prepared, coarse);
        });
    };
    const volume::GridSize n = volume.lattice().size();
    if (coarseFirst && (n.i > coarseSide || n.j > coarseSide || n.k > coarseSide)) {
        classify::ShownFields coarse{{}, fields.color};
        for (const classify::DensityField &field : fields.channels)
            coarse.channels.push_back(classify::coarseField(field, coarseSide));
        announce(coarse, true, progress.part(0.1, 0.25));
    }
    announce(fields, false, progress.part(0.25, 1.0));
}

void StudyOpener::openPaths(const QStringList &paths) {
    if (paths.isEmpty())
        return;
    m_document.clearProblems();
    std::vector<std::filesystem::path> files;
    for (const QString &path : paths)
        files.emplace_back(path.toStdString());
    m_jobs.start(tr("Reading headers"), [this, files, paths](const Job &job) {
        auto catalogue =
            std::make_shared<const dicom::Catalogue>(dicom::scan(files, job.progress()));
        job.deliver([this, catalogue, files, paths] {
            m_document.addProblems(catalogue->skipped);
            if (catalogue->empty()) {
                if (catalogue->skipped.empty())
                    m_document.addProblems({{files.front(), "holds no images"}});
                m_scanning = false;
                prepareAgain(); // what the scan stopped
                return;
            }
            const auto indices = m_document.addSources(sourcesFrom(catalogue));
            emit pathsOpened(paths);
            m_scanning = false;
            openSource(indices[defaultSource(*catalogue)]);
        });
    });
    m_scanning = true;
}

void StudyOpener::openPhantom(const QString &kind) {
    openSource(m_document.addSources({phantomSource(kind)}).front());
}

void StudyOpener::openSource(int index) {
    // What is shown or on its way already need not come again.
    if (index == m_document.currentSource() && (m_document.volume() || m_jobs.isRunning())) {
        if (m_document.volume())
            prepareAgain(); // what a scan stopped
        return;
    }
    const StudySource source = m_document.sources().at(std::size_t(index));
    // First, because the end of the former job tidies up after it.
    m_jobs.cancel();
    m_prepared.reset();
    m_givenUp.reset();
    Prepared wanted(m_document.scene());
    wanted.window.reset(); // a new volume has its own
    wanted.look = {};
    m_document.setCurrentSource(index);
    m_document.closeVolume();
    m_jobs.start(tr("Loading %1").arg(source.series), [this, source, wanted](const Job &job) {
        dicom::LoadObserver observer;
        observer.preview = [&](const volume::Volume &soFar) {
            const volume::ValueWindow window = initialWindow(soFar);
            job.deliver([this, soFar, window] { m_document.setVolume(soFar, window, true); });
        };
        const dicom::LoadedVolume loaded = source.load(job.progress().part(0.0, 0.6), observer);
        const volume::Volume volume = loaded.volume;
        const volume::ValueWindow window = initialWindow(volume);
        job.deliver([this, loaded, window] {
            m_document.addProblems(loaded.skipped);
            m_document.setVolume(loaded.volume, window, false);
            // The quality may have been changed while the volume came.
            followScene();
        });
        if (!volume.notes().placed) {
            job.deliver([this, volume] {
                const auto &warnings = volume.notes().warnings;
                emit notProjectable(warnings.empty() ? tr("images only")
                                                     : QString::fromStdString(warnings.back()));
            });
            return;
        }
        job.stage(tr("Preparing the projection"));
        prepare(job, volume, wanted, 0.6, true);
    });
    m_underway = wanted;
}

} // namespace pellucid::ui
