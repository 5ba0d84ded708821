// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/dicom/catalogue.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::dicom {

/// What loading may tell while it runs. Called from worker threads, never two at a time.
struct LoadObserver {
    /// The volume so far: slices that have not arrived are at the lowest value. Called now and
    /// then.
    std::function<void(const volume::Volume &)> preview;
};

struct LoadedVolume {
    volume::Volume volume;
    /// Files that turned out unreadable only when decoded; the stack was made without them.
    std::vector<Skipped> skipped;
};

/// Decodes and assembles a volume: rescale per frame, padding replaced by the lowest real value,
/// uneven stacks resampled along the stack. Samples are int16 where every value fits, else float32.
/// *Throws* Error{unusable} if nothing can be decoded or what is left makes no volume,
/// Error{outOfMemory}, Cancelled.
LoadedVolume loadVolume(const VolumeEntry &entry, const task::Progress &progress = {},
                        const LoadObserver &observer = {});

} // namespace pellucid::dicom
