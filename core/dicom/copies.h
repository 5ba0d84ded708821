// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/dicom/catalogue.h"
#include "core/dicom/stack_geometry.h"

namespace pellucid::dicom {

/// A digest of the frame's instance, place and modality, kept in memory only: frames with different
/// digests are different images, whatever the names of their files. It prevents mix-ups, not
/// forgery. The standard library's hash is sufficient: it reads some 200 bytes, where the scan has
/// just read and parsed a file.
std::size_t digestOf(const std::string &sopInstanceUid, const std::string &frameOfReferenceUid,
                     const std::string &modality, const FrameHeader &frame);

std::size_t digestOf(const PlacedFrame &frame);

/// Drops second copies of an instance, as when a CD is copied into a folder that contains it
/// already, and adds their files to `skipped`. Some tools write one UID into all images of a
/// series, or into an Enhanced file and the slices extracted from it: those are different images,
/// and are kept.
void dropCopies(std::vector<PlacedFrame> &frames, std::vector<Skipped> &skipped);

} // namespace pellucid::dicom
