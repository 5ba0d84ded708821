// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study_opener.h"

#include <algorithm>
#include <filesystem>

#include "core/classify/coarse_field.h"
#include "core/classify/density_field.h"
#include "core/dicom/scan.h"
#include "core/render/render_plan.h"
#include "core/task/memory.h"
#include "ui/document.h"
#include "ui/job_runner.h"
#include "ui/study_source.h"
#include "ui/window_presets.h"

namespace pellucid::ui {

namespace {

// The coarse projection: small enough to be there within a blink of the volume.
constexpr int coarseSide = 96;

std::shared_ptr<render::ProjectionEngine> makeEngine(const classify::DensityField &field,
                                                     const render::Scene &scene,
                                                     double &predictedError,
                                                     const task::Progress &progress) {
    const render::RenderPlan plan =
        render::planRender(scene, render::summarise(field), {task::availableMemoryBytes()});
    predictedError = plan.predictedError;
    return std::make_shared<render::CpuEngine>(
        std::make_shared<const fourier::Spectrum>(
            fourier::Spectrum::prepare(field.values, plan.spectrum, progress)),
        plan.room);
}

} // namespace

StudyOpener::StudyOpener(Document &document, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs) {
    qRegisterMetaType<std::shared_ptr<render::ProjectionEngine>>();
    connect(&document, &Document::sceneChanged, this, &StudyOpener::followFieldWindow);
}

void StudyOpener::followFieldWindow() {
    const auto &wanted = m_document.scene().fieldWindow;
    const auto &volume = m_document.volume();
    if (!volume || m_document.isPreview() || !volume->notes().placed || wanted == m_preparedWindow)
        return;
    m_preparedWindow = wanted;
    m_jobs.start(tr("Preparing the projection"),
                 [this, volume = *volume, scene = m_document.scene()](const Job &job) {
                     prepare(job, volume, scene, 0.0);
                 });
}

void StudyOpener::prepare(const Job &job, const volume::Volume &volume, const render::Scene &scene,
                          double from) {
    const task::Progress progress = job.progress().part(from, 1.0);
    const auto field = classify::densityField(
        volume, scene.fieldWindow.value_or(classify::defaultFieldWindow(volume)),
        progress.part(0.0, 0.1));
    const auto announce = [&](const classify::DensityField &f, bool coarse,
                              const task::Progress &p) {
        double error = 0.0;
        auto engine = makeEngine(f, scene, error, p);
        job.deliver([this, engine, error, coarse] { emit engineReady(engine, error, coarse); });
    };
    const volume::GridSize n = volume.lattice().size();
    if (n.i > coarseSide || n.j > coarseSide || n.k > coarseSide)
        announce(classify::coarseField(field, coarseSide), true, progress.part(0.1, 0.25));
    announce(field, false, progress.part(0.25, 1.0));
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
                return;
            }
            const auto indices = m_document.addSources(sourcesFrom(catalogue));
            emit pathsOpened(paths);
            openSource(indices[defaultSource(*catalogue)]);
        });
    });
}

void StudyOpener::openPhantom(const QString &kind) {
    openSource(m_document.addSources({phantomSource(kind)}).front());
}

void StudyOpener::openSource(int index) {
    // What is shown or on its way already need not come again.
    if (index == m_document.currentSource() && (m_document.volume() || m_jobs.isRunning()))
        return;
    const StudySource source = m_document.sources().at(std::size_t(index));
    // First, because the end of the former job tidies up after it.
    m_jobs.cancel();
    m_preparedWindow.reset();
    m_document.setCurrentSource(index);
    m_document.closeVolume();
    m_jobs.start(tr("Loading %1").arg(source.series), [this, source](const Job &job) {
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
        // Planned for the whole volume in a picture of its own; the pane's zoom comes and goes.
        render::Scene scene;
        scene.camera.pixelMm = volume.lattice().shortestStepMm();
        scene.camera.width = scene.camera.height =
            int(std::clamp(2.0 * volume.lattice().radiusMm() / scene.camera.pixelMm, 2.0, 4096.0));
        prepare(job, volume, scene, 0.6);
    });
}

} // namespace pellucid::ui
