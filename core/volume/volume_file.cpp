// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/volume/volume_file.h"

#include "core/system/text.h"

namespace pellucid::volume {

std::string volumeSuffix(const std::filesystem::path &path) {
    const std::string name = system::lowered(path.filename().string());
    for (const char *const suffix : {".nrrd", ".nhdr", ".nii.gz", ".nii", ".mha", ".mhd"})
        if (name.ends_with(suffix))
            return suffix;
    return {};
}

bool isVolumeFile(const std::filesystem::path &path) {
    return !volumeSuffix(path).empty();
}

} // namespace pellucid::volume
