// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/classify/density_field.h"
#include "core/classify/look.h"

namespace pellucid::classify {

/// Whether the look has classes of the volume, and each of them is restricted to the body. Segments
/// are not changed by removing the couch.
bool isWithoutCouch(const Look &look);

/// Restricts every class of the volume to the body, before its other regions. A look without
/// classes becomes one class, the patient, with the curve of the look.
void removeCouch(Look &look, const FieldWindow &window);

/// The reverse: removes the step `body` from every class of the volume, or the class of the patient
/// that `removeCouch` made.
void restoreCouch(Look &look, const FieldWindow &window);

} // namespace pellucid::classify
