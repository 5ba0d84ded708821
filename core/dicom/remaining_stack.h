// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/dicom/entry_files.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// What is left of a volume without the files that turned out unusable.
struct RemainingStack {
    VolumeEntry entry;
    std::vector<Skipped> skipped;
};

/// Slices that cannot be decoded are missing slices: the geometry is worked out again without them,
/// as if they had never been in the folder. *Shape*: `files` as of `filesOf`; `failures`: why each
/// is unusable, or nothing. *Throws* Error{unusable} if what is left makes no volume, an error of
/// code `noneLeft` if nothing is left; Cancelled.
RemainingStack remainingStack(const VolumeEntry &entry, const std::vector<EntryFile> &files,
                              const std::vector<std::optional<task::Reason>> &failures,
                              task::ErrorCode noneLeft, const task::Progress &progress);

} // namespace pellucid::dicom
