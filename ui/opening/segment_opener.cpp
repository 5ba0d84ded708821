// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/segment_opener.h"

#include <utility>

#include <QFileInfo>

#include "core/preprocess/segment_class.h"
#include "core/task/error.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/engine/look_preparer.h"
#include "ui/jobs/job_runner.h"
#include "ui/opening/reasons.h"

namespace pellucid::ui {

LoadedSegments loadSegments(const QStringList &paths, const volume::Volume &volume,
                            std::shared_ptr<const segment::SegmentSet> present,
                            const task::Progress &progress) {
    LoadedSegments loaded{std::move(present), {}};
    double done = 0.0;
    for (const QString &path : paths) {
        const std::filesystem::path file = path.toStdString();
        const double next = done + 1.0 / double(paths.size());
        try {
            segment::Segmentation segmentation =
                segment::loadSegmentation(file, volume, progress.part(done, next));
            for (const task::Reason &warning : segmentation.warnings)
                loaded.problems.push_back({file, warning});
            const segment::SegmentSet none(volume.lattice());
            loaded.set = (loaded.set ? *loaded.set : none).with(std::move(segmentation));
        } catch (const task::Error &error) {
            loaded.problems.push_back({error.path(), error.reason()});
        }
        done = next;
    }
    return loaded;
}

SegmentOpener::SegmentOpener(Document &document, JobRunner &jobs, LookPreparer &preparer,
                             QObject *parent)
    : QObject(parent), m_document(document), m_jobs(jobs), m_preparer(preparer) {}

void SegmentOpener::open(const QStringList &paths) {
    if (!m_document.volume() || m_document.isPreview() || paths.isEmpty())
        return;
    m_jobs.start(
        tr("Reading the segments of %1").arg(QFileInfo(paths.front()).fileName()),
        [this, paths, volume = *m_document.volume(),
         present = m_document.segments()](const Job &job) {
            const LoadedSegments loaded = loadSegments(paths, volume, present, job.progress());
            job.deliver([this, loaded] { show(loaded); });
        },
        {}, paths.front());
    m_preparer.awaitJob();
}

void SegmentOpener::show(const LoadedSegments &loaded) {
    m_document.addProblems(loaded.problems);
    const std::size_t before =
        m_document.segments() ? m_document.segments()->segmentations().size() : 0;
    if (!loaded.set || loaded.set->segmentations().size() == before)
        return;
    m_document.setSegments(loaded.set);
    std::size_t leftOut = 0;
    editScene(m_document, tr("Open segmentation"), noDrag, [&](scene::Scene &scene) {
        std::size_t index = scene.look.classes.size();
        const auto &all = loaded.set->segmentations();
        for (std::size_t n = before; n < all.size(); ++n)
            for (const segment::Segment &segment : all[n].segments)
                if (scene.look.classes.size() < classify::maxClasses)
                    classify::addClass(scene.look, preprocess::classOf(segment, index++));
                else
                    ++leftOut;
    });
    if (leftOut > 0)
        m_document.addProblems({{loaded.set->segmentations().back().path,
                                 task::because::tooManyClassesToAdd(classify::maxClasses)}});
}

} // namespace pellucid::ui
