// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/classify/look.h"
#include "core/task/reasons.h"

namespace pellucid::classify {

/// A look as a JSON object: the weights as `transfer_function`, unless it is plain; and `classes`,
/// each with name, range, softness, weight, color, steps and optionally a transfer_function.
std::string toJson(const Look &look);

/// Reads such an object; ignores unknown keys. *Throws* Error{usage} with the JSON pointer of the
/// error (`because::at`).
Look lookFromJson(const std::string &text);

} // namespace pellucid::classify
