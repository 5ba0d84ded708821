// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/classify/tissue_class.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::classify {

/// Where a sample lies after the steps of a class: outside it; where its value decides; or in a gap
/// that a closing filled, where it belongs to the class whatever its value.
enum class Region : std::uint8_t { outside, inside, filled };

/// What a class is shown with: the window's density; its value over the end of the class's range,
/// for values that are no longer the volume's, such as gradients; or one, for edges.
enum class DensityKind { window, range, one };

/// What the steps of a class leave of a volume.
struct ClassSamples {
    volume::Volume values;
    DensityKind density = DensityKind::window;
    /// *Shape*: one of each sample; none: inside everywhere.
    std::shared_ptr<const std::vector<Region>> regions;
};

/// Runs the steps of classes. Apart from the classes because only core/preprocess knows how.
class StepRunner {
public:
    virtual ~StepRunner() = default;
    /// *Throws* Error{outOfMemory}, Cancelled.
    virtual ClassSamples run(const volume::Volume &volume, const TissueClass &tissue,
                             const task::Progress &progress) = 0;
};

/// The samples of a class: the volume's own, or what the runner makes of its steps. *Throws*
/// Error{usage} if there are steps and nothing to run them.
ClassSamples samplesOf(const volume::Volume &volume, const TissueClass &tissue, StepRunner *runner,
                       const task::Progress &progress = {});

} // namespace pellucid::classify
