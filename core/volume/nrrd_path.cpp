// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/text.h"
#include "core/volume/nrrd.h"

namespace pellucid::volume {

bool isNrrdPath(const std::filesystem::path &path) {
    const std::string suffix = task::lowered(path.extension().string());
    return suffix == ".nrrd" || suffix == ".nhdr";
}

} // namespace pellucid::volume
