// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::files {
class JsonFields;
class JsonValue;
} // namespace pellucid::files

namespace pellucid::classify {

/// A color is "#rrggbb", a window a list of two numbers. *Throw* as JsonValue.
nlohmann::json jsonOf(const Color &color);
void readFrom(const files::JsonValue &in, Color &color);
nlohmann::json jsonOf(const FieldWindow &window);
void readFrom(const files::JsonValue &in, FieldWindow &window);

/// The fields of a look: `transfer_function`, unless it is plain; and `classes`, each with name,
/// range, softness, weight, color, steps and optionally a transfer_function.
void fields(files::JsonFields &io, Look &look);

} // namespace pellucid::classify
