// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/scene/camera.h"

class QKeyEvent;

namespace pellucid::ui {

/// The view that a key of the keypad shows: 1, 3 and 7, with Shift from the opposite side.
std::optional<scene::StandardView> standardViewOf(const QKeyEvent &event);

} // namespace pellucid::ui
