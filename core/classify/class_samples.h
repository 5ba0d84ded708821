// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/classify/tissue_class.h"
#include "core/task/progress.h"
#include "core/volume/coverage.h"
#include "core/volume/volume.h"

namespace pellucid::classify {

/// The region of a sample after the steps of a class: outside; inside, where its value decides; or
/// filled: added by a step (closing, growing, another class, a stroke), where it belongs to the
/// class whatever its value.
enum class Region : std::uint8_t { outside, inside, filled };

/// The density that a class is shown with: that of the window; the value divided by the upper end
/// of the class's range, if it has one, for values such as gradients that are no longer the
/// volume's; or 1, for edges.
enum class DensityKind { window, range, one };

/// The samples of a class after its steps.
struct ClassSamples {
    volume::Volume values;
    DensityKind density = DensityKind::window;
    /// *Shape*: one per sample; null: inside everywhere.
    std::shared_ptr<const std::vector<Region>> regions;
    /// The share of each sample that belongs to the class's region; null: all of it.
    std::shared_ptr<const volume::Coverage> coverage;
};

/// Finds the samples of classes: takes their segments and runs their steps. An interface, because
/// they are implemented in core/preprocess.
class StepRunner {
public:
    virtual ~StepRunner() = default;
    /// *Throws* Error{usage} if the class's segment is not loaded, or if its steps name other
    /// classes (see `withOperands`); Error{outOfMemory}, Cancelled.
    virtual ClassSamples run(const volume::Volume &volume, const TissueClass &tissue,
                             const task::Progress &progress) = 0;
};

/// The samples of a class: the volume's own, or the runner's result. *Throws* Error{usage} if there
/// are steps or a segment but no runner.
ClassSamples samplesOf(const volume::Volume &volume, const TissueClass &tissue, StepRunner *runner,
                       const task::Progress &progress = {});

} // namespace pellucid::classify
