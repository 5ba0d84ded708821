// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening/recent_paths.h"

#include <algorithm>
#include <filesystem>

#include <QCryptographicHash>
#include <QDir>
#include <QRegularExpression>
#include <QSettings>

#include "core/files/atomic_file.h"
#include "core/files/read_text.h"
#include "core/files/user_folders.h"
#include "core/task/error.h"
#include "ui/document/document.h"
#include "ui/library/study_library.h"
#include "ui/settings/preferences.h"
#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace fs = std::filesystem;

namespace {

constexpr int recentCount = 8;
constexpr const char *recentKey = "recentPaths", *exportKey = "exportFolder";

constexpr const char *studyPrefix = "study:";

QString digestOf(const StudyFacts &study) {
    return QCryptographicHash::hash(study.key().toUtf8(), QCryptographicHash::Sha256)
        .toHex()
        .left(32);
}

constexpr int longWord = 4;

// Letters and digits, without case and accents; each letter is one.
QStringList wordsOf(const QString &text) {
    static const QRegularExpression between("[^\\p{L}\\p{N}]+");
    return folded(text).normalized(QString::NormalizationForm_C).split(between, Qt::SkipEmptyParts);
}

// Short words are parts of too many others, and initials of all; two letters of East Asia are a
// name.
bool isAmong(const QString &word, const QStringList &words) {
    constexpr char16_t firstIdeograph = 0x2E80;
    const bool isEastAsian = !word.isEmpty() && word.front().unicode() >= firstIdeograph;
    if (!isEastAsian && word.size() < 2)
        return false;
    return std::any_of(words.begin(), words.end(), [&](const QString &other) {
        return other == word || (isEastAsian ? word.size() >= 2 && other.contains(word)
                                             : word.size() >= longWord && (other.startsWith(word) ||
                                                                           other.endsWith(word)));
    });
}

} // namespace

QString recentEntry(const StudyFacts &study) {
    return studyPrefix + QString::number(study.libraryId) + ":" + digestOf(study);
}

std::optional<StudyFacts> recentStudy(const QString &entry, StudyLibrary &library) {
    const QStringList parts = entry.split(':');
    if (!entry.startsWith(studyPrefix) || parts.size() != 3)
        return std::nullopt;
    const auto study = library.study(parts[1].toLongLong());
    // Numbers are given again: to another study.
    return study && digestOf(*study) == parts[2] ? study : std::nullopt;
}

namespace {

constexpr const char *privatePrefix = "private:";

std::optional<fs::path> privateFile(const QString &digest) {
    const auto folder = files::userDataFolder();
    return folder ? std::optional(*folder / "recent" / (digest.toStdString() + ".path"))
                  : std::nullopt;
}

void removePrivate(const QString &entry) {
    std::error_code ignored;
    if (entry.startsWith(privatePrefix))
        if (const auto file = privateFile(entry.section(':', 1, 1)))
            fs::remove(*file, ignored);
}

} // namespace

std::optional<QString> privateEntry(const QString &path, const QString &label) {
    const QString digest =
        QCryptographicHash::hash(path.toUtf8(), QCryptographicHash::Sha256).toHex().left(32);
    const auto file = privateFile(digest);
    if (!file)
        return std::nullopt;
    try {
        std::error_code ignored; // the write reports it
        fs::create_directories(file->parent_path(), ignored);
        files::AtomicFile written(*file);
        written.write(path.toStdString());
        written.commit();
    } catch (const task::Error &) {
        return std::nullopt;
    }
    return QString("%1%2:%3").arg(privatePrefix, digest, label);
}

QString privateLabel(const QString &entry) {
    return entry.startsWith(privatePrefix) ? entry.section(':', 2) : QString();
}

QString pathOf(const QString &entry) {
    if (!entry.startsWith(privatePrefix))
        return entry;
    constexpr std::size_t longestPath = 1 << 16;
    try {
        if (const auto file = privateFile(entry.section(':', 1, 1)))
            return QString::fromStdString(files::readText(*file, longestPath));
    } catch (const task::Error &) {
        // The file is gone: so is the entry.
    }
    return {};
}

bool namesPatient(const QString &path, const StudyFacts &study) {
    static const QRegularExpression notDigits("[^0-9]");
    if (!study.hasPatient())
        return false;
    QString in = path;
    if (const QString home = QDir::homePath() + "/"; in.startsWith(home))
        in.remove(0, home.size()); // it names who sits there
    const QStringList pathWords = wordsOf(in);
    for (const QString &group : study.patientName.split('=')) { // in other letters each
        QStringList words = wordsOf(group);
        words << words.join("");
        if (std::any_of(words.begin(), words.end(),
                        [&](const QString &word) { return isAmong(word, pathWords); }))
            return true;
    }
    const QString number = wordsOf(study.patientId).join("");
    const QString &born = study.birthDate; // as year, month, day
    const QStringList dates{born, born.mid(6, 2) + born.mid(4, 2) + born.left(4),
                            born.mid(4, 2) + born.mid(6, 2) + born.left(4)};
    for (const QString &component : in.split('/')) {
        const QString letters = wordsOf(component).join("");
        const bool hasNumber = number.size() >= longWord
                                   ? letters.contains(number)
                                   : !number.isEmpty() && pathWords.contains(number);
        QString digits = letters;
        digits.remove(notDigits);
        if (hasNumber ||
            (born.size() == 8 && std::any_of(dates.begin(), dates.end(), [&](const QString &date) {
                 return digits.contains(date);
             })))
            return true;
    }
    return false;
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
        // The label of a private entry may have changed.
        const QString known = path.startsWith(privatePrefix) ? path.section(':', 0, 1) + ":" : path;
        recent.removeIf([&](const QString &other) {
            return other == path || (known != path && other.startsWith(known));
        });
        recent.prepend(path);
    }
    for (const QString &old : recent.mid(recentCount))
        removePrivate(old);
    QSettings().setValue(recentKey, recent.mid(0, recentCount));
}

void forgetRecentPath(const QString &path) {
    QStringList recent = recentPaths();
    if (recent.removeAll(path) > 0)
        QSettings().setValue(recentKey, recent);
}

void forgetPaths() {
    for (const QString &entry : recentPaths())
        removePrivate(entry);
    QSettings().setValue(recentKey,
                         recentPaths().filter(QRegularExpression(QString("^") + studyPrefix)));
    QSettings().remove(exportKey);
}

void forgetRecentPaths() {
    for (const QString &entry : recentPaths())
        removePrivate(entry);
    QSettings().remove(recentKey);
    QSettings().remove(exportKey);
}

QString exportFolder() {
    return QSettings().value(exportKey, QDir::homePath()).toString();
}

void setExportFolder(const QString &folder, const Document &document) {
    if (mayBeKept(folder, document))
        QSettings().setValue(exportKey, folder);
    else
        QSettings().remove(exportKey);
}

} // namespace pellucid::ui
