// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

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
/// reference and modality. If positions still repeat, it splits by the first attribute that
/// distinguishes them (temporal position, acquisition, echo, b-value, ...), or else by the order of
/// the files. Copies of an instance are dropped and added to `skipped`. Frames without position or
/// orientation become sets of images that contain the reason. *Throws* Cancelled.
std::vector<VolumeEntry> groupSeries(const std::vector<SeriesFile> &files,
                                     std::vector<Skipped> &skipped,
                                     const task::Progress &progress = {},
                                     Slices slices = Slices::all);

/// Whether a frame is a picture for planning a scan (scout, topogram), by its ImageType.
bool isLocalizer(const FrameHeader &frame);

/// A digest of the frame's instance, place and modality, kept in memory only: frames with different
/// digests are different images, whatever the names of their files. It prevents mix-ups, not
/// forgery. The standard library's hash is sufficient: it reads some 200 bytes, where the scan has
/// just read and parsed a file.
std::size_t digestOf(const std::string &sopInstanceUid, const std::string &frameOfReferenceUid,
                     const std::string &modality, const FrameHeader &frame);

} // namespace pellucid::dicom
