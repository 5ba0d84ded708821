// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/preprocess/step_cache.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/preprocess/content_digest.h"
#include "core/preprocess/edges.h"
#include "core/preprocess/filters.h"
#include "core/segment/coverages.h"
#include "core/task/error.h"

namespace pellucid::preprocess {

namespace {

using classify::ClassSamples;
using classify::DensityKind;
using classify::Region;
using classify::Step;
using classify::StepKind;
using classify::TissueClass;
using Regions = std::shared_ptr<const std::vector<Region>>;
using SharedCoverage = std::shared_ptr<const volume::Coverage>;
// The result of a step: values or regions, by its effect; or a segment on another lattice or with
// other edges.
using Outcome = std::variant<volume::Volume, Regions, SharedCoverage>;

std::string geometryText(const volume::Lattice &l) {
    std::string text = fmt::format("{}x{}x{}", l.size().i, l.size().j, l.size().k);
    for (int d = 0; d < 3; ++d)
        text += fmt::format(" {},{},{}", l.step(d).x, l.step(d).y, l.step(d).z);
    return text;
}

std::string identity(const volume::Volume &volume) {
    const std::string samples =
        volume.visit([](auto s) { return contentDigest(std::as_bytes(s)); });
    return fmt::format("{} {} {}", samples, geometryText(volume.lattice()), int(volume.unit()));
}

bool isMostlyIn(const volume::Coverage &coverage, volume::VoxelIndex n) {
    return 2 * coverage.at(n) >= volume::Coverage::whole;
}

// The samples whose membership of a class is at least a half after the steps so far.
Mask belonging(const TissueClass &tissue, const ClassSamples &now) {
    const volume::GridSize size = now.values.lattice().size();
    Mask mask(size.count());
    now.values.visit([&](auto samples) {
        tbb::parallel_for(0, size.k, [&](int k) {
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    const std::size_t n = size.offsetOf(i, j, k);
                    const Region where = now.regions ? (*now.regions)[n] : Region::inside;
                    const bool isCovered = !now.coverage || isMostlyIn(*now.coverage, {i, j, k});
                    mask[n] =
                        where == Region::filled || (where == Region::inside && isCovered &&
                                                    tissue.membership(double(samples[n])) >= 0.5);
                }
        });
    });
    return mask;
}

// The regions after a step has kept a part of the class: the part, and the rim around it in which
// membership fades. Samples that were outside stay outside, and filled gaps stay filled.
std::vector<Region> partOf(const volume::Lattice &lattice, const Mask &before, const Mask &kept,
                           const Regions &former) {
    const volume::GridSize size = lattice.size();
    std::vector<Region> regions(kept.size(), Region::outside);
    tbb::parallel_for(0, size.k, [&](int k) {
        for (int j = 0; j < size.j; ++j)
            for (int i = 0; i < size.i; ++i) {
                const std::size_t n = size.offsetOf(i, j, k);
                const Region was = former ? (*former)[n] : Region::inside;
                bool touches = kept[n] != 0;
                if (!touches && before[n] == 0 && was != Region::outside)
                    for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.k - 1); ++z)
                        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.j - 1); ++y)
                            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, size.i - 1); ++x)
                                touches = touches || kept[size.offsetOf(x, y, z)] != 0;
                if (touches)
                    regions[n] = was;
            }
    });
    return regions;
}

Regions shared(std::vector<Region> regions) {
    return std::make_shared<const std::vector<Region>>(std::move(regions));
}

Regions insideOf(const Mask &mask) {
    std::vector<Region> regions(mask.size());
    std::transform(mask.begin(), mask.end(), regions.begin(),
                   [](std::uint8_t m) { return m != 0 ? Region::inside : Region::outside; });
    return shared(std::move(regions));
}

// The regions whose values fulfil a condition that does not depend on the class.
template <class F> Regions insideWhere(const volume::Volume &values, const F &holds) {
    Mask mask(values.lattice().size().count());
    values.visit([&](auto samples) {
        for (std::size_t n = 0; n < mask.size(); ++n)
            mask[n] = holds(double(samples[n]));
    });
    return insideOf(mask);
}

volume::Volume smoothGradient(const volume::Volume &values, double sigmaMm,
                              const task::Progress &progress) {
    return gradientMagnitude(sigmaMm > 0.0 ? gaussian(values, sigmaMm, progress.part(0.0, 0.8))
                                           : values,
                             progress.part(0.8, 1.0));
}

// The regions before a closing, with the gaps that it filled.
Regions withFilled(const Regions &before, const Mask &now, const Mask &closed) {
    std::vector<Region> regions =
        before ? *before : std::vector<Region>(closed.size(), Region::inside);
    for (std::size_t n = 0; n < closed.size(); ++n)
        if (closed[n] != 0 && now[n] == 0)
            regions[n] = Region::filled;
    return shared(std::move(regions));
}

// The result of a step on a class after the steps before it.
Outcome outcomeOf(const Step &step, const TissueClass &tissue, const ClassSamples &before,
                  const task::Progress &progress) {
    const volume::Volume &values = before.values;
    const volume::Lattice &lattice = values.lattice();
    const auto given = [&](const char *parameter) { return step.at(parameter); };
    const auto now = [&] { return belonging(tissue, before); };
    const auto part = [&](const Mask &all, const Mask &kept) {
        return shared(partOf(lattice, all, kept, before.regions));
    };
    switch (step.kind) {
    case StepKind::gaussian:
        return gaussian(values, given("sigma_mm"), progress);
    case StepKind::median:
        return median(values, given("radius_mm"), progress);
    case StepKind::diffusion:
        return diffusion(values, int(given("iterations")), given("conductance"), progress);
    case StepKind::gradient:
        return smoothGradient(values, given("sigma_mm"), progress);
    case StepKind::threshold:
        return insideWhere(values, [low = given("low"), high = given("high")](double value) {
            return value >= low && value <= high;
        });
    case StepKind::edges: {
        const CannyOptions options{given("sigma_mm"), given("low"), given("high")};
        return insideOf(given("itk") == 1.0 ? cannyEdgesByItk(values, options, progress)
                                            : cannyEdges(values, options, progress));
    }
    case StepKind::binarise:
        return insideWhere(values, [from = given("from")](double value) { return value >= from; });
    case StepKind::opening: {
        const Mask all = now();
        const auto open = given("itk") == 1.0 ? openingByItk : opening;
        return part(all, open(lattice, all, given("radius_mm"), progress));
    }
    case StepKind::closing: {
        const Mask all = now();
        const auto close = given("itk") == 1.0 ? closingByItk : closing;
        return withFilled(before.regions, all, close(lattice, all, given("radius_mm"), progress));
    }
    case StepKind::largestComponent: {
        const Mask all = now();
        return part(all, largestPart(lattice, all, given("share"), progress));
    }
    case StepKind::body:
        return insideOf(body(values, given("margin_mm"), progress));
    case StepKind::skin:
        return insideOf(skin(values, given("depth_mm"), given("margin_mm"), progress));
    }
    std::abort(); // the switch handles every kind
}

// Whether the result of a step depends on the class, not only on the values.
bool dependsOnClass(StepKind kind) {
    switch (kind) {
    case StepKind::opening:
    case StepKind::closing:
    case StepKind::largestComponent:
        return true;
    case StepKind::gaussian:
    case StepKind::median:
    case StepKind::diffusion:
    case StepKind::gradient:
    case StepKind::threshold:
    case StepKind::edges:
    case StepKind::binarise:
    case StepKind::body:
    case StepKind::skin:
        break;
    }
    return false;
}

// How a class is shown after a step, if the step changes that.
std::optional<DensityKind> densityAfter(StepKind kind) {
    switch (kind) {
    case StepKind::gradient:
        return DensityKind::range;
    case StepKind::edges:
    case StepKind::binarise:
        return DensityKind::one;
    case StepKind::gaussian:
    case StepKind::median:
    case StepKind::diffusion:
    case StepKind::threshold:
    case StepKind::opening:
    case StepKind::closing:
    case StepKind::largestComponent:
    case StepKind::body:
    case StepKind::skin:
        break;
    }
    return std::nullopt;
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
    return shared(std::move(joined));
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
    std::shared_ptr<const segment::SegmentSet> segments;
    std::size_t budget = 0, bytes = 0, computed = 0;
    std::list<Entry> entries; ///< the most recently used first
};

// Finds the samples of one class.
class StepCache::ClassRun {
public:
    ClassRun(Store &store, const volume::Volume &volume, const TissueClass &tissue)
        : m_store(store), m_tissue(tissue), m_now{volume} {}

    ClassSamples result(const task::Progress &progress) {
        takeSegment();
        runSteps(progress);
        soften();
        return std::move(m_now);
    }

private:
    void takeSegment() {
        if (m_tissue.segment.empty())
            return;
        std::shared_ptr<const segment::SegmentSet> segments;
        {
            const std::lock_guard lock(m_store.mutex);
            segments = m_store.segments;
        }
        const segment::Segment *const found = segments ? segments->find(m_tissue.segment) : nullptr;
        if (found == nullptr)
            throw task::Error(task::ErrorCode::usage,
                              task::because::segmentIsMissing(m_tissue.name, m_tissue.segment));
        const volume::Lattice &lattice = m_now.values.lattice();
        m_segmentKey = fmt::format("segment {}", found->id);
        m_now.coverage = found->coverage;
        if (lattice == segments->lattice())
            return;
        m_segmentKey += " on " + geometryText(lattice);
        m_now.coverage = m_store.find<SharedCoverage>(m_segmentKey, [&] {
            return std::make_shared<const volume::Coverage>(
                segment::coarsened(*found->coverage, segments->lattice(), lattice));
        });
    }

    void runSteps(const task::Progress &progress) {
        if (m_tissue.steps.empty())
            return;
        std::string valuesKey = identity(m_now.values);
        for (std::size_t n = 0; n < m_tissue.steps.size(); ++n) {
            const Step &step = m_tissue.steps[n];
            const double count = double(m_tissue.steps.size());
            const task::Progress part = progress.part(double(n) / count, double(n + 1) / count);
            const std::string text = " | " + classify::stepText(step);
            const auto make = [&] { return outcomeOf(step, m_tissue, m_now, part); };
            m_now.density = densityAfter(step.kind).value_or(m_now.density);
            if (classify::describe(step.kind).effect == classify::StepEffect::values) {
                valuesKey += text;
                m_now.values = m_store.find<volume::Volume>(valuesKey, make);
                continue;
            }
            std::string key = valuesKey + text;
            if (dependsOnClass(step.kind))
                key += fmt::format(" of {} {} {} {} {}", m_tissue.low, m_tissue.high,
                                   m_tissue.softness, m_segmentKey, m_regionsKey);
            const auto found = m_store.find<Regions>(key, make);
            // The result of a step that depends on the class contains the earlier regions already.
            m_now.regions = dependsOnClass(step.kind) ? found : intersection(m_now.regions, found);
            m_regionsKey += text;
        }
    }

    // The region of the steps becomes a part of the coverage, and the edges of both fade. Filled
    // samples keep their whole share.
    void soften() {
        if (m_tissue.edge == 0.0 || (!m_now.coverage && !m_now.regions))
            return;
        const volume::GridSize size = m_now.values.lattice().size();
        if (!m_now.regions) {
            m_now.coverage = m_store.find<SharedCoverage>(
                fmt::format("{} edge {}", m_segmentKey, m_tissue.edge), [&] {
                    return std::make_shared<const volume::Coverage>(
                        segment::softened(*m_now.coverage, size, m_tissue.edge));
                });
            return;
        }
        const std::vector<Region> &regions = *m_now.regions;
        volume::Coverage region{m_now.values.lattice().bounds(), {}};
        region.shares.resize(size.count());
        bool hasFilled = false;
        for (int k = 0; k < size.k; ++k)
            for (int j = 0; j < size.j; ++j)
                for (int i = 0; i < size.i; ++i) {
                    const std::size_t n = size.offsetOf(i, j, k);
                    hasFilled = hasFilled || regions[n] == Region::filled;
                    const std::uint8_t covered =
                        m_now.coverage ? m_now.coverage->at({i, j, k}) : volume::Coverage::whole;
                    region.shares[n] = regions[n] == Region::outside ? std::uint8_t(0)
                                       : regions[n] == Region::filled
                                           ? std::uint8_t(volume::Coverage::whole)
                                           : covered;
                }
        m_now.coverage = std::make_shared<const volume::Coverage>(
            segment::softened(region, size, m_tissue.edge));
        if (!hasFilled) {
            m_now.regions = nullptr;
            return;
        }
        // The faded rim is inside: there values decide, too.
        std::vector<Region> kept(regions.size(), Region::inside);
        std::transform(regions.begin(), regions.end(), kept.begin(), [](Region was) {
            return was == Region::filled ? Region::filled : Region::inside;
        });
        m_now.regions = shared(std::move(kept));
    }

    Store &m_store;
    const TissueClass &m_tissue;
    ClassSamples m_now;
    std::string m_segmentKey, m_regionsKey;
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

void StepCache::setSegments(std::shared_ptr<const segment::SegmentSet> segments) {
    const std::lock_guard lock(m_store->mutex);
    m_store->segments = std::move(segments);
}

ClassSamples StepCache::run(const volume::Volume &volume, const TissueClass &tissue,
                            const task::Progress &progress) {
    return task::orOutOfMemory(task::because::noMemoryForTheSteps(tissue.name),
                               [&] { return ClassRun(*m_store, volume, tissue).result(progress); });
}

} // namespace pellucid::preprocess
