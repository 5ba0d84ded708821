// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/recent_paths.h"

#include <algorithm>

#include <QCryptographicHash>
#include <QRegularExpression>
#include <QSettings>

#include "ui/document.h"
#include "ui/library/search_words.h"
#include "ui/library/study_library.h"
#include "ui/preferences.h"

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

bool namesPatient(const QString &path, const StudyFacts &study) {
    static const QRegularExpression between("[^\\p{L}\\p{N}]+");
    constexpr int fewLetters = 3;
    constexpr char16_t firstIdeograph = 0x2E80; // one of these is a word
    QStringList words = folded(study.patientName).split(between, Qt::SkipEmptyParts);
    words << folded(study.patientId) << study.birthDate;
    if (study.birthDate.size() == 8)
        words << study.birthDate.left(4) + "-" + study.birthDate.mid(4, 2) + "-" +
                     study.birthDate.right(2);
    const QString in = folded(path);
    return std::any_of(words.begin(), words.end(), [&](const QString &word) {
        const bool isLong = word.size() >= fewLetters ||
                            (!word.isEmpty() && word.front().unicode() >= firstIdeograph);
        return isLong && in.contains(word);
    });
}

bool mayBeKept(const QString &path, const Document &document) {
    const Preferences preferences = Preferences::load();
    if (!preferences.remembersStudies || preferences.showsPatient)
        return preferences.remembersStudies;
    return std::none_of(
        document.sources().begin(), document.sources().end(),
        [&](const StudySource &source) { return namesPatient(path, source.study); });
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
