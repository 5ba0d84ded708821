// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// Converts a reason to one line of a file and back. Line breaks in names are escaped. A
/// sentence that this version does not have is shown as the line gives it.
QString toLine(const task::Reason &reason);
task::Reason reasonFromLine(const QString &line);

/// Several reasons, one per line.
QString toLines(const std::vector<task::Reason> &reasons);
std::vector<task::Reason> reasonsFromLines(const QString &lines);
} // namespace pellucid::ui
