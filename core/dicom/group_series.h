// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/dicom/attribute_columns.h"
#include "core/dicom/catalogue.h"
#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// A file of a series with its header.
struct SeriesFile {
    std::filesystem::path path;
    InstanceHeader header;
};

/// Splits a series into volumes: first by size, orientation, pixel spacing, localizer, frame of
/// reference, modality, and whether a rescale is stated in full, in part or not at all. If
/// positions still repeat, or the stack is uneven, it then splits by the attributes that differ
/// between the parts, see `splitRepeats` and `splitOverlapping`; `read` supplies their values.
/// Copies of an instance are dropped and added to `skipped`. Frames without position or
/// orientation, and those that nothing distinguishes, become sets of images that contain the
/// reason. *Throws* Cancelled.
std::vector<VolumeEntry> groupSeries(const std::vector<SeriesFile> &files,
                                     std::vector<Skipped> &skipped,
                                     const task::Progress &progress = {},
                                     Slices slices = Slices::all, const ReadAttributes &read = {});

/// Whether a frame is a picture for planning a scan (scout, topogram), by its ImageType.
bool isLocalizer(const FrameHeader &frame);

/// How much a file says of what the samples of a frame mean: 0 to 2, one for a slope and one for
/// an intercept, two for a table.
int statedValues(const InstanceHeader &header, int frame);

} // namespace pellucid::dicom
