// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/dicom/entry_files.h"
#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// The rest of a volume without files that turned out to be unusable.
struct RemainingStack {
    VolumeEntry entry;
    std::vector<Skipped> skipped;
};

/// Computes the geometry again without the slices that cannot be decoded, as if they had never been
/// in the folder. *Shape*: `files` as by `filesOf`; `failures`: why each is unusable, or empty.
/// *Throws* Error{unusable} if the rest makes no volume, an error with code `noneLeft` if nothing
/// is left; Cancelled.
RemainingStack remainingStack(const VolumeEntry &entry, const std::vector<EntryFile> &files,
                              const std::vector<std::optional<task::Reason>> &failures,
                              task::ErrorCode noneLeft, const task::Progress &progress);

} // namespace pellucid::dicom
