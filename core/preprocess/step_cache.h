// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>

#include "core/classify/class_samples.h"

namespace pellucid::preprocess {

/// Runs the steps of classes and keeps what they gave, by content: the same values on the same
/// lattice with the same steps are not computed twice, whichever class or reloaded series asks.
/// What was used longest ago goes first when the budget is full. Safe to call from several threads.
class StepCache final : public classify::StepRunner {
public:
    explicit StepCache(std::size_t budgetBytes);
    ~StepCache() override;

    classify::ClassSamples run(const volume::Volume &volume, const classify::TissueClass &tissue,
                               const task::Progress &progress) override;

    std::size_t bytes() const;
    /// How often something was computed, not found.
    std::size_t computedCount() const;
    /// Keeps no more than this.
    void trim(std::size_t budgetBytes);

private:
    struct Store;
    std::unique_ptr<Store> m_store;
};

} // namespace pellucid::preprocess
