// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/presets/preset.h"

namespace pellucid::files {
class JsonValue;
}

namespace pellucid::presets {

/// The preset as a JSON object, as `toJson` writes it.
nlohmann::json jsonOf(const Preset &preset);
/// Reads it, with what it does not know. *Throws* as JsonValue.
Preset presetFrom(const files::JsonValue &in);

} // namespace pellucid::presets
