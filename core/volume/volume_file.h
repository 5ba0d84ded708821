// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace pellucid::volume {

/// True if a path looks like a file of volumes that is no DICOM: NRRD (.nrrd, .nhdr), NIfTI (.nii,
/// .nii.gz) or MetaImage (.mha, .mhd). What reads one: `decoder::readVolumeFile`.
bool isVolumeFile(const std::filesystem::path &path);

/// The suffix that such a path ends in, in lower case.
std::string volumeSuffix(const std::filesystem::path &path);

} // namespace pellucid::volume
