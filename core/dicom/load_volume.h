// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/dicom/catalogue.h"
#include "core/dicom/decoded_files.h"
#include "core/task/progress.h"
#include "core/volume/volume.h"

namespace pellucid::dicom {

/// Callbacks during loading. They are called from worker threads, one at a time.
struct LoadObserver {
    /// The volume so far; missing slices have the lowest value. Called from time to time.
    std::function<void(const volume::Volume &)> preview;
};

struct LoadedVolume {
    volume::Volume volume;
    /// Files that turned out to be unreadable when decoded; the volume lacks them.
    std::vector<Skipped> skipped;
};

/// Decodes and assembles a volume: applies the rescale of each frame, replaces padding by the
/// lowest real value, and resamples uneven stacks along the stack. Samples are int16 if every value
/// fits, else float32. `decoded`: files that are not decoded again; may be null. *Throws*
/// Error{unusable} if nothing can be decoded or the rest makes no volume, Error{outOfMemory},
/// Cancelled.
LoadedVolume loadVolume(const VolumeEntry &entry, const task::Progress &progress = {},
                        const LoadObserver &observer = {}, const DecodedFiles *decoded = nullptr);

} // namespace pellucid::dicom
