// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace pellucid::volume {

/// Whether a path has the extension of a non-DICOM volume file: NRRD (.nrrd, .nhdr), NIfTI (.nii,
/// .nii.gz) or MetaImage (.mha, .mhd). `decoding::readVolumeFile` reads it.
bool isVolumeFile(const std::filesystem::path &path);

/// The extension of such a path, in lower case.
std::string volumeSuffix(const std::filesystem::path &path);

} // namespace pellucid::volume
