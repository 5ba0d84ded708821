// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>

#include "core/volume/nrrd.h"

namespace pellucid::volume {

bool isNrrdPath(const std::filesystem::path &path) {
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return suffix == ".nrrd" || suffix == ".nhdr";
}

} // namespace pellucid::volume
