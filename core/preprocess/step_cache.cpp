// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/step_cache.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <span>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "core/classify/reasons.h"
#include "core/preprocess/class_region.h"
#include "core/preprocess/coverage_where.inc"
#include "core/preprocess/reasons.h"
#include "core/preprocess/step_result.h"
#include "core/segment/coverages.h"
#include "core/system/content_digest.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::ClassSamples;
using classify::Region;
using classify::Step;
using classify::TissueClass;
using SharedCoverage = std::shared_ptr<const volume::Coverage>;
// A kept result: of a step, or a segment on another lattice or with other edges.
using Outcome = std::variant<volume::Volume, Regions, SharedCoverage>;

std::string geometryText(const volume::Lattice &l) {
    std::string text = fmt::format("{}x{}x{}", l.size().i, l.size().j, l.size().k);
    for (int d = 0; d < 3; ++d)
        text += fmt::format(" {},{},{}", l.step(d).x, l.step(d).y, l.step(d).z);
    return text;
}

std::string identity(const volume::Volume &volume) {
    const std::string samples =
        volume.visit([](auto s) { return system::contentDigest(std::as_bytes(s)); });
    return fmt::format("{} {} {}", samples, geometryText(volume.lattice()), int(volume.unit()));
}

// The intersection; a gap that either has filled is filled.
Regions intersection(const Regions &a, const Regions &b) {
    if (!a)
        return b;
    std::vector<Region> joined(a->size());
    for (std::size_t n = 0; n < joined.size(); ++n)
        joined[n] = (*a)[n] == Region::outside || (*b)[n] == Region::outside
                        ? Region::outside
                        : std::max((*a)[n], (*b)[n]);
    return std::make_shared<const std::vector<Region>>(std::move(joined));
}

} // namespace

struct StepCache::Store {
    struct Entry {
        std::string key;
        Outcome value;
        std::size_t bytes;
    };

    template <class T> T find(const std::string &key, const std::function<Outcome()> &make) {
        {
            const std::lock_guard lock(mutex);
            const auto found = std::find_if(entries.begin(), entries.end(),
                                            [&](const Entry &e) { return e.key == key; });
            if (found != entries.end()) {
                entries.splice(entries.begin(), entries, found);
                return std::get<T>(entries.front().value);
            }
        }
        T made = std::get<T>(make());
        const std::lock_guard lock(mutex);
        ++computed;
        std::size_t size = 0;
        if constexpr (std::is_same_v<T, volume::Volume>)
            size = made.bytes();
        else if constexpr (std::is_same_v<T, SharedCoverage>)
            size = made->shares.size();
        else
            size = made->size();
        entries.push_front({key, made, size});
        bytes += size;
        drop(budget);
        return made;
    }
    void drop(std::size_t maxBytes) {
        while (bytes > maxBytes && !entries.empty()) {
            bytes -= entries.back().bytes;
            entries.pop_back();
        }
    }

    mutable std::mutex mutex;
    std::size_t budget = 0, bytes = 0, computed = 0;
    std::list<Entry> entries; ///< the most recently used first
};

// Finds the samples of one class.
class StepCache::ClassRun {
public:
    ClassRun(Store &store, const segment::SegmentSet *segments, const volume::Volume &volume,
             const TissueClass &tissue)
        : m_store(store), m_segments(segments), m_volume(volume), m_tissue(tissue), m_now{volume} {}

    ClassSamples result(const task::Progress &progress) {
        takeSegment(progress);
        if (m_tissue.isDrawn)
            m_now.regions = std::make_shared<const std::vector<Region>>(
                m_now.values.lattice().size().count(), Region::outside);
        runSteps(progress.part(0.0, 0.8));
        joinRegions();
        soften(progress);
        progress.report(1.0);
        return std::move(m_now);
    }

private:
    void takeSegment(const task::Progress &progress) {
        if (m_tissue.segment.empty())
            return;
        const segment::Segment *const found =
            m_segments != nullptr ? m_segments->find(m_tissue.segment) : nullptr;
        if (found == nullptr)
            throw task::Error(task::ErrorCode::usage,
                              task::because::segmentIsMissing(m_tissue.name, m_tissue.segment));
        const volume::Lattice &lattice = m_now.values.lattice();
        m_coverageKey = fmt::format("segment {}", found->id);
        m_now.coverage = found->coverage;
        if (lattice == m_segments->lattice())
            return;
        const glm::dvec3 origin = lattice.origin().mm;
        m_coverageKey +=
            fmt::format(" on {} at {},{},{}", geometryText(lattice), origin.x, origin.y, origin.z);
        m_now.coverage = m_store.find<SharedCoverage>(m_coverageKey, [&] {
            return std::make_shared<const volume::Coverage>(
                segment::coarsened(*found->coverage, m_segments->lattice(), lattice, progress));
        });
    }

    void runSteps(const task::Progress &progress) {
        if (m_tissue.steps.empty())
            return;
        std::string valuesKey = identity(m_volume);
        for (std::size_t n = 0; n < m_tissue.steps.size(); ++n) {
            const Step &step = m_tissue.steps[n];
            if (awaitsPoints(step))
                continue;
            const double count = double(m_tissue.steps.size());
            const task::Progress part = progress.part(double(n) / count, double(n + 1) / count);
            const std::string text = " | " + contentText(step);
            const auto make = [&] {
                auto operand = operandOf(step, part.part(0.0, 0.7));
                const task::Progress own = operand ? part.part(0.7, 1.0) : part;
                return std::visit([](auto made) { return Outcome(std::move(made)); },
                                  resultOf(step, {m_tissue, m_now, std::move(operand)}, own));
            };
            m_now.density = densityAfter(step.kind).value_or(m_now.density);
            if (classify::describe(step.kind).effect == classify::StepEffect::values) {
                valuesKey += text;
                m_now.values = m_store.find<volume::Volume>(valuesKey, make);
                continue;
            }
            std::string key = valuesKey + text;
            if (dependsOnClass(step.kind))
                key +=
                    fmt::format(" of {} {} {} {} {} {}", m_tissue.low, m_tissue.high,
                                m_tissue.softness, m_tissue.isDrawn, m_coverageKey, m_regionsKey);
            const auto found = m_store.find<Regions>(key, make);
            // The result of a step that depends on the class contains the earlier regions already.
            m_now.regions = dependsOnClass(step.kind) ? found : intersection(m_now.regions, found);
            m_regionsKey += text;
        }
    }

    // The region of a step's other class, found from the volume's own values; null if the step has
    // none.
    std::shared_ptr<const volume::Coverage> operandOf(const Step &step,
                                                      const task::Progress &progress) {
        if (classify::describe(step.kind).input != classify::StepInput::otherClass)
            return nullptr;
        if (!step.operand.own)
            throw task::Error(task::ErrorCode::usage,
                              task::because::classIsMissing(m_tissue.name, step.operand.name));
        Runner runner(m_store, m_segments);
        return std::make_shared<const volume::Coverage>(
            regionOf(m_volume, *step.operand.own, runner, progress));
    }

    // Runs the classes of operands with the same store.
    class Runner final : public classify::StepRunner {
    public:
        Runner(Store &store, const segment::SegmentSet *segments)
            : m_store(store), m_segments(segments) {}
        ClassSamples run(const volume::Volume &volume, const TissueClass &tissue,
                         const task::Progress &progress) override {
            return ClassRun(m_store, m_segments, volume, tissue).result(progress);
        }

    private:
        Store &m_store;
        const segment::SegmentSet *m_segments;
    };

    // Identifies a step by its kind, numbers and input.
    std::string contentText(const Step &step) const {
        std::string text = classify::stepText(step);
        const auto add = [&](const volume::PatientPoint &p) {
            text += fmt::format(" {},{},{}", p.mm.x, p.mm.y, p.mm.z);
        };
        std::for_each(step.points.begin(), step.points.end(), add);
        for (const classify::Stroke &stroke : step.strokes) {
            text += fmt::format(" stroke {} {}", stroke.radiusMm, stroke.erases);
            std::for_each(stroke.path.begin(), stroke.path.end(), add);
        }
        for (const classify::LassoCut &cut : step.cuts) {
            text +=
                fmt::format(" cut {},{},{} {}", cut.sight.x, cut.sight.y, cut.sight.z, cut.keeps);
            if (cut.slabMm)
                text += fmt::format(" {} {}", (*cut.slabMm)[0], (*cut.slabMm)[1]);
            std::for_each(cut.outline.begin(), cut.outline.end(), add);
        }
        if (step.points.empty() && step.strokes.empty() && step.cuts.empty() && !step.operand.own)
            return text;
        if (step.operand.own)
            text += " (" + contentText(*step.operand.own) + ")";
        // Marks are places in the patient; other results are the same wherever the volume is.
        add(m_volume.lattice().origin());
        // Strokes can be long, and the store compares keys one by one.
        return classify::describe(step.kind).name + " " +
               system::contentDigest(std::as_bytes(std::span(text)));
    }

    std::string contentText(const TissueClass &tissue) const {
        std::string text =
            fmt::format("{} {} {} {}", tissue.low, tissue.high, tissue.softness, tissue.isDrawn);
        const segment::Segment *const found =
            m_segments != nullptr ? m_segments->find(tissue.segment) : nullptr;
        text += fmt::format(" segment {}", found != nullptr ? found->id : 0);
        for (const Step &step : tissue.steps)
            text += " | " + contentText(step);
        return text;
    }

    // Where the edges fade, and within a segment, the region of the steps becomes part of the
    // coverage. Filled samples belong to it with their whole share.
    void joinRegions() {
        if (!m_now.regions || (m_tissue.edge == 0.0 && !m_now.coverage))
            return;
        const std::vector<Region> &regions = *m_now.regions;
        std::atomic<bool> hasFilled = false;
        m_now.coverage = std::make_shared<const volume::Coverage>(
            coverageWhere(m_now.values.lattice().size(), [&](volume::VoxelIndex at, std::size_t n) {
                if (regions[n] == Region::filled)
                    hasFilled.store(true, std::memory_order_relaxed);
                return shareOf(regions[n], at);
            }));
        m_coverageKey.clear(); // is not kept
        if (!hasFilled) {
            m_now.regions = nullptr;
            return;
        }
        // The faded rim is inside: there values decide, too.
        std::vector<Region> kept(regions.size(), Region::inside);
        std::transform(regions.begin(), regions.end(), kept.begin(), [](Region was) {
            return was == Region::filled ? Region::filled : Region::inside;
        });
        m_now.regions = std::make_shared<const std::vector<Region>>(std::move(kept));
    }

    std::uint8_t shareOf(Region where, volume::VoxelIndex n) const {
        if (where == Region::outside)
            return 0;
        if (where == Region::filled || !m_now.coverage)
            return volume::Coverage::whole;
        return m_now.coverage->at(n);
    }

    void soften(const task::Progress &progress) {
        if (m_tissue.edge == 0.0 || !m_now.coverage)
            return;
        const auto make = [&] {
            return std::make_shared<const volume::Coverage>(segment::softened(
                *m_now.coverage, m_now.values.lattice().size(), m_tissue.edge, progress));
        };
        m_now.coverage = m_coverageKey.empty()
                             ? make()
                             : m_store.find<SharedCoverage>(
                                   fmt::format("{} edge {}", m_coverageKey, m_tissue.edge), make);
    }

    Store &m_store;
    const segment::SegmentSet *m_segments;
    const volume::Volume &m_volume;
    const TissueClass &m_tissue;
    ClassSamples m_now;
    std::string m_coverageKey, m_regionsKey;
};

StepCache::StepCache(std::size_t budgetBytes) : m_store(std::make_unique<Store>()) {
    m_store->budget = budgetBytes;
}
StepCache::~StepCache() = default;

std::size_t StepCache::bytes() const {
    const std::lock_guard lock(m_store->mutex);
    return m_store->bytes;
}

std::size_t StepCache::computedCount() const {
    const std::lock_guard lock(m_store->mutex);
    return m_store->computed;
}

void StepCache::trim(std::size_t budgetBytes) {
    const std::lock_guard lock(m_store->mutex);
    m_store->drop(budgetBytes);
}

ClassSamples StepCache::run(const volume::Volume &volume, const TissueClass &tissue,
                            const task::Progress &progress) {
    return run(volume, tissue, nullptr, progress);
}

ClassSamples StepCache::run(const volume::Volume &volume, const TissueClass &tissue,
                            const segment::SegmentSet *segments, const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheSteps(tissue.name), [&] {
        return ClassRun(*m_store, segments, volume, tissue).result(progress);
    });
}

} // namespace pellucid::preprocess
