// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

namespace pellucid::ui {

/// The paths opened last, newest first, from the user's settings.
QStringList recentPaths();
/// Puts paths in front; the oldest beyond eight go.
void addRecentPaths(const QStringList &paths);
void forgetRecentPaths();

} // namespace pellucid::ui
