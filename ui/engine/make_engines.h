// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "core/prepare/layer_set.h"
#include "core/prepare/next_step.h"
#include "core/preprocess/step_cache.h"

namespace pellucid::ui {

/// What the engines of a look are made from.
struct EngineSource {
    volume::Volume volume;
    prepare::PreparedFor wanted;
    std::shared_ptr<preprocess::StepCache> steps;        ///< results of the classes' steps
    std::shared_ptr<const segment::SegmentSet> segments; ///< of the volume; may be null
};

/// The fields of the look, which pictures of it are measured against.
prepare::StudyFields studyFields(const EngineSource &source);

/// Receives an engine, coarse or full, on the job's thread.
using TakeEngine = std::function<void(const prepare::PreparedEngine &, prepare::Detail)>;
/// The same for layers.
using TakeLayers = std::function<void(const std::shared_ptr<prepare::LayerSet> &, prepare::Detail)>;

/// Makes the engine of a look and passes it to `take`. If `first` is coarse, a large volume gets a
/// coarse engine before that.
/// *Throws* Error{outOfMemory}, Cancelled.
void makeEngine(const EngineSource &source, prepare::Detail first, const TakeEngine &take,
                const task::Progress &progress);

/// Makes only a coarse engine, of at most `side` samples along each axis. *Throws* as above.
void makeCoarseEngine(const EngineSource &source, int side, const TakeEngine &take,
                      const task::Progress &progress);

/// Makes the layers of a look; a large volume gets coarse ones first. *Throws* Error{outOfMemory},
/// Cancelled.
void makeLayers(const EngineSource &source, const TakeLayers &take, const task::Progress &progress);

} // namespace pellucid::ui
