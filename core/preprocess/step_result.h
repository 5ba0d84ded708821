// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/classify/class_samples.h"

namespace pellucid::preprocess {

/// *Shape*: one per sample.
using Regions = std::shared_ptr<const std::vector<classify::Region>>;
/// The result of a step: values or regions, by its effect.
using StepResult = std::variant<volume::Volume, Regions>;

/// The input of a step.
struct StepStart {
    const classify::TissueClass &tissue;
    const classify::ClassSamples &before; ///< the samples after the steps before it
    /// The region of the step's other class; null if it has none.
    std::shared_ptr<const volume::Coverage> operand;
};

/// Runs one step of a class. *Throws* Error{outOfMemory}, Cancelled.
StepResult resultOf(const classify::Step &step, const StepStart &start,
                    const task::Progress &progress);

/// Whether the result of a step depends on the class, not only on the values.
bool dependsOnClass(classify::StepKind kind);

/// How a class is shown after a step, if the step changes that.
std::optional<classify::DensityKind> densityAfter(classify::StepKind kind);

} // namespace pellucid::preprocess
