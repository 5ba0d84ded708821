// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QString>

#include "core/task/reason.h"

namespace pellucid::ui {

/// A reason as a line of a file, which a name within it cannot break, and back. Earlier programs
/// wrote English words; these stay as they are.
QString toLine(const task::Reason &reason);
task::Reason reasonFromLine(const QString &line);

/// Several, a line each.
QString toLines(const std::vector<task::Reason> &reasons);
std::vector<task::Reason> reasonsFromLines(const QString &lines);
/// What tells a volume from others, which earlier programs wrote as a list with commas.
std::vector<task::Reason> labelFromLines(const QString &lines);

} // namespace pellucid::ui
