// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/dicom/write_capture.h"
#include "core/segment/segmentation.h"
#include "core/task/progress.h"

namespace pellucid::segment {

/// The study that a written segmentation belongs to.
struct SegmentationLabels {
    dicom::CaptureLabels study;      ///< patient and study
    std::string frameOfReferenceUid; ///< of the volume; empty: a new one
    std::string seriesDescription = "Segmentation";
};

/// Writes segments as a DICOM segmentation (PS3.3, A.51): binary if every share is 0 or 255, else
/// fractional. Slices without a sample of a segment are left out. *Requires*: at least one segment.
/// *Throws* Error{usage} for a volume of more than 65535 rows or columns, Error{output}, Cancelled.
void writeSegmentation(const std::filesystem::path &path, const std::vector<Segment> &segments,
                       const volume::Lattice &lattice, const SegmentationLabels &labels,
                       const task::Progress &progress = {});

/// Writes segments as a NRRD volume of labels, 1 for the first, with their names and colors as 3D
/// Slicer reads them. A sample belongs to a segment if at least half of it does. *Throws*
/// Error{usage} if segments overlap, which labels cannot express; Error{output}, Cancelled.
/// *Returns* the number of samples of each segment.
std::vector<std::size_t> writeLabels(const std::filesystem::path &path,
                                     const std::vector<Segment> &segments,
                                     const volume::Lattice &lattice,
                                     const task::Progress &progress = {});

} // namespace pellucid::segment
