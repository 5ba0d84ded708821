// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "core/classify/class_samples.h"
#include "core/segment/segment_set.h"

namespace pellucid::preprocess {

/// Takes the segments of classes, runs their steps, and keeps the results by content: the same
/// steps on the same values and lattice are computed once, even for a different class or a reloaded
/// series. When the budget is full, the least recently used results are dropped. Safe to call from
/// several threads.
class StepCache final : public classify::StepRunner {
public:
    explicit StepCache(std::size_t budgetBytes);
    ~StepCache() override;

    classify::ClassSamples run(const volume::Volume &volume, const classify::TissueClass &tissue,
                               const task::Progress &progress) override;
    /// The same for classes that may be parts of these segments; null: of none.
    classify::ClassSamples run(const volume::Volume &volume, const classify::TissueClass &tissue,
                               const segment::SegmentSet *segments, const task::Progress &progress);

    std::size_t bytes() const;
    /// How many results were computed, not found.
    std::size_t computedCount() const;
    /// Drops the least recently used results until the others fit.
    void trim(std::size_t budgetBytes);

private:
    struct Store;
    class ClassRun;
    std::unique_ptr<Store> m_store;
};

/// A cache together with the segments of a volume. *Requires*: the cache outlives this object.
class ClassRunner final : public classify::StepRunner {
public:
    /// `segments`: null if none are loaded.
    ClassRunner(StepCache &steps, std::shared_ptr<const segment::SegmentSet> segments)
        : m_steps(steps), m_segments(std::move(segments)) {}

    classify::ClassSamples run(const volume::Volume &volume, const classify::TissueClass &tissue,
                               const task::Progress &progress) override {
        return m_steps.run(volume, tissue, m_segments.get(), progress);
    }

private:
    StepCache &m_steps;
    std::shared_ptr<const segment::SegmentSet> m_segments;
};

} // namespace pellucid::preprocess
