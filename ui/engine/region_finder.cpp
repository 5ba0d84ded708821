// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/engine/region_finder.h"

#include "core/preprocess/class_region.h"
#include "core/preprocess/step_cache.h"
#include "ui/document/document.h"

namespace pellucid::ui {

namespace {

// The last regions that were tried, of a large volume.
constexpr std::size_t candidateBytes = std::size_t(256) << 20;

} // namespace

RegionFinder::RegionFinder(Document &document, std::shared_ptr<preprocess::StepCache> steps,
                           QObject *parent)
    : QObject(parent), m_document(document), m_steps(std::move(steps)),
      m_candidateSteps(std::make_shared<preprocess::StepCache>(candidateBytes)) {
    const RegionMarking &marking = document.marking();
    for (const auto changed : {&RegionMarking::toolChanged, &RegionMarking::candidateChanged})
        connect(&marking, changed, this, &RegionFinder::update);
    document.whenever(
        Change::scene | Change::selection | Change::segments, this, [this](Changes changes) {
            if (changes & Change::segments) { // the same class of another volume is another region
                m_wanted.reset();
                m_document.marking().setTint(std::nullopt);
            }
            update();
        });
}

std::optional<classify::TissueClass> RegionFinder::wanted() const {
    if (!m_document.volume() || m_document.isPreview())
        return std::nullopt;
    const RegionMarking &marking = m_document.marking();
    if (marking.candidate())
        return marking.candidate();
    const int selected = m_document.selectedClass();
    if (marking.tool() == RegionTool::none || selected < 0)
        return std::nullopt;
    classify::TissueClass tissue =
        classify::withOperands(m_document.scene().look)[std::size_t(selected)];
    // The planes tint segments by themselves. A class without steps is the range of its values.
    if (tissue.steps.empty())
        return std::nullopt;
    tissue.weight = 1.0; // does not change its region
    return tissue;
}

void RegionFinder::update() {
    const auto now = wanted();
    if (now == m_wanted)
        return;
    m_wanted = now;
    if (m_wanted) {
        start();
        return;
    }
    m_jobs.cancel();
    m_document.marking().setSearching(false);
    m_document.marking().setTint(std::nullopt);
}

void RegionFinder::start() {
    m_document.marking().setSearching(true);
    // Regions that are only tried must not displace the results of the look.
    const auto &steps = m_document.marking().candidate() ? m_candidateSteps : m_steps;
    const auto find = [this, steps, volume = *m_document.volume(), segments = m_document.segments(),
                       tissue = *m_wanted](const Job &job) {
        preprocess::ClassRunner runner(*steps, segments);
        const auto found = std::make_shared<const volume::Coverage>(
            preprocess::regionOf(volume, tissue, runner, job.progress()));
        const RegionTint tint{found, tissue.color,
                              found->total() * volume.lattice().cellVolumeMm3() / 1000.0};
        job.deliver([this, tint] { m_document.marking().setTint(tint); });
    };
    m_jobs.start(tr("Finding the region"), find, [this](const Outcome &outcome) {
        if (outcome.kind == Outcome::Kind::cancelled)
            return; // by a newer wish
        if (outcome.kind == Outcome::Kind::failed)
            m_document.marking().setTint(std::nullopt);
        m_document.marking().setSearching(false);
    });
}

} // namespace pellucid::ui
