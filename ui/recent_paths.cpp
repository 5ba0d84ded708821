// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/recent_paths.h"

#include <QCryptographicHash>
#include <QSettings>

#include "ui/library/study_library.h"

namespace pellucid::ui {

namespace {

constexpr int recentCount = 8;
constexpr const char *recentKey = "recentPaths";

constexpr const char *studyPrefix = "study:";

QString digestOf(const StudyFacts &study) {
    return QCryptographicHash::hash(study.key().toUtf8(), QCryptographicHash::Sha256)
        .toHex()
        .left(32);
}

} // namespace

QString recentEntry(const StudyFacts &study) {
    return QString("%1%2:%3").arg(studyPrefix).arg(study.libraryId).arg(digestOf(study));
}

std::optional<StudyFacts> recentStudy(const QString &entry, StudyLibrary &library) {
    const QStringList parts = entry.split(':');
    if (!entry.startsWith(studyPrefix) || parts.size() != 3)
        return std::nullopt;
    const auto study = library.study(parts[1].toLongLong());
    // Numbers are given again: to another study.
    return study && digestOf(*study) == parts[2] ? study : std::nullopt;
}

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
