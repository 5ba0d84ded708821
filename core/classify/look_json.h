// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/classify/look.h"

namespace pellucid::classify {

/// A look as a JSON object: `transfer_function`, its weights, unless it is plain; and `classes`,
/// each with name, range, softness, weight, color, steps and perhaps a transfer_function.
std::string toJson(const Look &look);

/// From such an object; keys of others are left alone. *Throws* Error{usage} with the JSON
/// pointer of what is wrong (`because::at`).
Look lookFromJson(const std::string &text);

} // namespace pellucid::classify
