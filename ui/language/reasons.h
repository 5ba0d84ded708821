// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// In the user's language, with the reasons in it.
QString translated(const task::Reason &reason);
/// What tells a volume from others, as a list.
QString translated(const std::vector<task::Reason> &label);

} // namespace pellucid::ui
