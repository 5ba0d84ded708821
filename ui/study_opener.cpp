// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study_opener.h"

#include <filesystem>

#include "core/classify/coarse_field.h"
#include "core/classify/density_field.h"
#include "core/dicom/scan.h"
#include "core/render/render_plan.h"
#include "ui/document.h"
#include "ui/job_runner.h"
#include "ui/study_source.h"

namespace pellucid::ui {

namespace {

// The coarse projection: small enough to be there within a blink of the volume.
constexpr int coarseSide = 96;

std::shared_ptr<render::ProjectionEngine> makeEngine(const classify::DensityField &field,
                                                     double &predictedError,
                                                     const task::Progress &progress) {
    const render::RenderPlan plan = render::planRender({}, render::summarise(field));
    predictedError = plan.predictedError;
    return std::make_shared<render::CpuEngine>(std::make_shared<const fourier::Spectrum>(
        fourier::Spectrum::prepare(field.values, plan.spectrum, progress)));
}

} // namespace

StudyOpener::StudyOpener(Document &document, JobRunner &jobs, QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs) {
    qRegisterMetaType<std::shared_ptr<render::ProjectionEngine>>();
}

void StudyOpener::openPaths(const QStringList &paths) {
    if (paths.isEmpty())
        return;
    m_document.clearProblems();
    std::vector<std::filesystem::path> files;
    for (const QString &path : paths)
        files.emplace_back(path.toStdString());
    m_jobs.start(tr("Reading headers"), [this, files](const Job &job) {
        auto catalogue =
            std::make_shared<const dicom::Catalogue>(dicom::scan(files, job.progress()));
        job.deliver([this, catalogue, files] {
            m_document.addProblems(catalogue->skipped);
            if (catalogue->empty()) {
                if (catalogue->skipped.empty())
                    m_document.addProblems({{files.front(), "holds no images"}});
                return;
            }
            const auto first = int(m_document.sources().size());
            m_document.addSources(sourcesFrom(catalogue));
            openSource(first + int(defaultSource(*catalogue)));
        });
    });
}

void StudyOpener::openPhantom(const QString &kind) {
    const StudySource wanted = phantomSource(kind);
    const auto &sources = m_document.sources();
    for (std::size_t n = 0; n < sources.size(); ++n)
        if (sources[n].patient == wanted.patient && sources[n].series == wanted.series) {
            openSource(int(n));
            return;
        }
    m_document.addSources({wanted});
    openSource(int(m_document.sources().size()) - 1);
}

void StudyOpener::openSource(int index) {
    const StudySource source = m_document.sources().at(std::size_t(index));
    m_document.setCurrentSource(index);
    m_document.closeVolume();
    m_jobs.start(tr("Loading %1").arg(source.series), [this, source](const Job &job) {
        dicom::LoadObserver observer;
        observer.preview = [&](const volume::Volume &soFar) {
            job.deliver([this, soFar] { m_document.setVolume(soFar, true); });
        };
        const dicom::LoadedVolume loaded = source.load(job.progress().part(0.0, 0.6), observer);
        const volume::Volume volume = loaded.volume;
        job.deliver([this, loaded] {
            m_document.addProblems(loaded.skipped);
            m_document.setVolume(loaded.volume, false);
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
        const auto field = classify::densityField(volume, classify::defaultFieldWindow(volume),
                                                  job.progress().part(0.6, 0.65));
        const auto announce = [&](const classify::DensityField &f, bool coarse,
                                  const task::Progress &progress) {
            double error = 0.0;
            auto engine = makeEngine(f, error, progress);
            job.deliver([this, engine, error, coarse] { emit engineReady(engine, error, coarse); });
        };
        const volume::GridSize n = volume.lattice().size();
        if (n.i > coarseSide || n.j > coarseSide || n.k > coarseSide)
            announce(classify::coarseField(field, coarseSide), true,
                     job.progress().part(0.65, 0.7));
        announce(field, false, job.progress().part(0.7, 1.0));
    });
}

} // namespace pellucid::ui
