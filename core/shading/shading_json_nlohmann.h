// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/shading/shading.h"

namespace pellucid::files {
class JsonValue;
}

namespace pellucid::shading {

/// The shading as a JSON object with `cue`, `ambient` and `lights`, as far as they differ from the
/// defaults.
nlohmann::json jsonOf(const Shading &shading);

/// Reads such an object; ignores unknown keys. *Throws* as JsonValue.
Shading shadingFrom(const files::JsonValue &in);

} // namespace pellucid::shading
