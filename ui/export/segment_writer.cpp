// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/export/segment_writer.h"

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "core/preprocess/segment_class.h"
#include "core/preprocess/step_cache.h"
#include "core/segment/reasons.h"
#include "core/segment/write_segmentation.h"
#include "core/system/text.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/export/capture_labels.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;

// Two classes may share the steps of one.
constexpr std::size_t stepsBytes = std::size_t(256) << 20;

struct Writing {
    fs::path path;
    volume::Volume volume;
    std::vector<classify::TissueClass> classes;
    std::shared_ptr<const segment::SegmentSet> loaded;
    segment::SegmentationLabels labels;

    QStringList run(const task::Progress &progress) const;
};

QStringList Writing::run(const task::Progress &progress) const {
    preprocess::StepCache steps(stepsBytes);
    preprocess::ClassRunner runner(steps, loaded);
    std::vector<segment::Segment> segments;
    std::set<std::string> taken;
    QStringList empty;
    for (std::size_t n = 0; n < classes.size(); ++n) {
        const double done = 0.8 * double(n) / double(classes.size());
        segment::Segment segment =
            preprocess::segmentOf(volume, classes[n], loaded.get(), runner,
                                  progress.part(done, done + 0.8 / double(classes.size())));
        segment.name = system::uniqueName(segment.name, taken);
        if (segment.coverage->isEmpty())
            empty << QString::fromStdString(segment.name);
        else
            segments.push_back(std::move(segment));
    }
    if (segments.empty())
        throw task::Error(task::ErrorCode::unusable, task::because::noSegmentInTheVolume, path);
    const task::Progress writing = progress.part(0.8, 1.0);
    if (path.extension() != ".nrrd") {
        segment::writeSegmentation(path, segments, volume.lattice(), labels, writing);
        return empty;
    }
    const auto counts = segment::writeLabels(path, segments, volume.lattice(), writing);
    for (std::size_t n = 0; n < counts.size(); ++n)
        if (counts[n] == 0) // no sample belongs to it at least half
            empty << QString::fromStdString(segments[n].name);
    return empty;
}

} // namespace

SegmentWriter segmentWriter(const Document &document, const QString &path) {
    const fs::path file = path.toStdString();
    document.requireOther({file});
    const volume::Volume &volume = *document.volume();
    segment::SegmentationLabels labels;
    labels.study = studyLabels(document);
    labels.frameOfReferenceUid = volume.notes().frameOfReferenceUid;
    const Writing writing{file, volume, classify::visibleClasses(document.scene().look),
                          document.segments(), labels};
    return [writing](const task::Progress &progress) { return writing.run(progress); };
}

} // namespace pellucid::ui
