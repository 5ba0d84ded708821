// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.h"

namespace pellucid::files {
class JsonValue;
}

namespace pellucid::scene {

/// The scene as a JSON object, as `toJson` writes it.
nlohmann::json jsonOf(const Scene &scene);
/// Reads and validates it. *Throws* as JsonValue.
Scene sceneFrom(const files::JsonValue &in);

} // namespace pellucid::scene
