// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// A reason in the user's language, with the reasons among its arguments.
QString translated(const task::Reason &reason);
/// The label that distinguishes a volume from others, as a list.
QString translated(const std::vector<task::Reason> &label);

} // namespace pellucid::ui
