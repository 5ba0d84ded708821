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

/// Splits one series into volumes: by size, orientation, pixel spacing, localizer, frame of
/// reference and modality first; where
/// positions then still repeat, by the first attribute that tells them apart (temporal position,
/// acquisition, echo, b-value, ...), at last by the order of the files. Copies of the same instance
/// are dropped and listed. Frames without position or orientation become sets of images with the
/// reason. *Throws* Cancelled.
std::vector<VolumeEntry> groupSeries(const std::vector<SeriesFile> &files,
                                     std::vector<Skipped> &skipped,
                                     const task::Progress &progress = {});

/// What identifies a frame's image, its place and its kind of values: frames of other digests are
/// other images, whatever their file is named. A hash against mix-ups: who forges can forge it.
std::size_t digestOf(const std::string &sopInstanceUid, const std::string &frameOfReferenceUid,
                     const std::string &modality, const FrameHeader &frame);

/// What is wrong with the values of files, and how many have it: pixels beyond those that the
/// header describes, a rescale slope of 0.
std::vector<task::Reason> warningsOfValues(const std::vector<const InstanceHeader *> &files);
/// Whether a warning is one of those.
bool isOfValues(const task::Reason &warning);

} // namespace pellucid::dicom
