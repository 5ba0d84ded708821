// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/decoding/client/instance.h"
#include "core/dicom/catalogue.h"

namespace pellucid::dicom {

/// A file of a volume, and the frames of the volume that it contains.
struct EntryFile {
    std::filesystem::path path;
    std::vector<std::size_t> frames; ///< indices in `VolumeEntry::frames`, ascending
};

/// The files of a volume, each once, in the order of their first frames.
std::vector<EntryFile> filesOf(const VolumeEntry &entry);

/// Whether a file that was read again still contains the frame that the scan found.
bool stillContains(const FrameReference &expected, const decoding::InstanceHeader &found);

} // namespace pellucid::dicom
