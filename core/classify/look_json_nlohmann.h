// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/classify/look.h"

namespace pellucid::files {
class JsonValue;
}

namespace pellucid::classify {

/// A look as a JSON object: `transfer_function`, unless it is plain; and `classes`, each with name,
/// range, softness, weight, color, steps and optionally a transfer_function.
nlohmann::json jsonOf(const Look &look);

/// Reads such an object; ignores unknown keys. *Throws* as JsonValue.
Look lookFrom(const files::JsonValue &in);

} // namespace pellucid::classify
