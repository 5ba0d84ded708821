// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/files/json_value_nlohmann.h"
#include "core/scene/projection_matrix.h"

namespace pellucid::scene {

/// A list of views within another file. *Throws* as JsonValue.
ViewList viewListFrom(const files::JsonValue &in);
/// One view: an object, or text: front, back, left, right, top, bottom, or angles.
ViewList::View viewFrom(const files::JsonValue &in);

} // namespace pellucid::scene
