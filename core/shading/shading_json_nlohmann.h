// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/shading/shading.h"

namespace pellucid::files {
class JsonFields;
}

namespace pellucid::shading {

/// The fields of a shading: `cue`, `ambient` and `lights`, as far as they differ from the defaults.
void fields(files::JsonFields &io, Shading &shading);
nlohmann::json jsonOf(const Shading &shading);

} // namespace pellucid::shading
