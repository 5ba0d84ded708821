// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/recent_paths.h"

#include <QSettings>

namespace pellucid::ui {

namespace {

constexpr int recentCount = 8;
constexpr const char *recentKey = "recentPaths";

} // namespace

QStringList recentPaths() {
    return QSettings().value(recentKey).toStringList();
}

void addRecentPaths(const QStringList &paths) {
    QStringList recent = recentPaths();
    for (const QString &path : paths) {
        recent.removeAll(path);
        recent.prepend(path);
    }
    QSettings().setValue(recentKey, recent.mid(0, recentCount));
}

void forgetRecentPaths() {
    QSettings().remove(recentKey);
}

} // namespace pellucid::ui
