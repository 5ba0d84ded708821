// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include <QDate>
#include <QRegularExpression>

#include "core/files/atomic_file.h"
#include "core/files/file_lock.h"
#include "core/files/session_folder.h"
#include "core/system/log.h"
#include "core/task/error.h"
#include "ui/library/library.h"
#include "ui/library/list_query.h"
#include "ui/library/reasons.h"

namespace pellucid::ui {

namespace {

namespace because = task::because;
namespace fs = std::filesystem;
using task::Error;

// Whether a scan wrote this row, as opposed to disk damage. Values may violate the DICOM standard,
// but they are printable.
bool isPlausible(const LibrarySeries &s) {
    static const QRegularExpression printable("^[ -~]{0,64}$");
    const auto texts = {s.study.uid, s.study.date, s.volumes.front().seriesUid};
    return std::all_of(texts.begin(), texts.end(),
                       [](const QString &text) { return printable.match(text).hasMatch(); });
}

// Reads rows one by one, by number: each intact path down the tree of pages still leads to its
// rows, even if pages beside it are damaged.
void forEachReadableRow(const QSqlDatabase &list, const QString &table, const QString &columns,
                        const std::function<void(const ListQuery &)> &f) {
    qint64 last = 0;
    try {
        ListQuery numbers(list, QString("SELECT max(id) FROM %1").arg(table));
        numbers.run();
        last = numbers.next() ? numbers.integer(0) : 0;
    } catch (const Error &) {
        return; // the root of the tree is damaged
    }
    // A number that exceeds the file size is damaged.
    std::error_code unknown;
    const auto bytes = fs::file_size(list.databaseName().toStdString(), unknown);
    if (!unknown)
        last = std::min(last, qint64(bytes));
    ListQuery row(list, QString("SELECT %1 FROM %2 WHERE id = ?").arg(columns, table));
    for (qint64 id = 1; id <= last; ++id) {
        try {
            row.bind(id).run();
            if (row.next())
                f(row);
        } catch (const Error &) {
            // The row is on a damaged page.
        }
    }
}

std::vector<LibrarySeries> salvage(const QSqlDatabase &list, int &lost) {
    std::map<qint64, StudyFacts> studies;
    forEachReadableRow(list, "studies", studyColumns,
                       [&](const ListQuery &row) { studies[row.integer(0)] = studyOf(row); });
    std::map<qint64, LibrarySeries> series;
    forEachReadableRow(list, "series", seriesColumns, [&](const ListQuery &row) {
        const auto study = studies.find(row.integer(1));
        if (study == studies.end())
            return;
        LibrarySeries &s = series[row.integer(0)];
        s.study = study->second;
        s.volumes.push_back(seriesOf(row));
        try {
            s.files = filesOfSeries(list, row.integer(0));
        } catch (const Error &) {
            // A series without files cannot be kept.
        }
    });
    std::set<qint64> described;
    forEachReadableRow(list, "volumes", volumeColumns, [&](const ListQuery &row) {
        const auto s = series.find(row.integer(1));
        if (s == series.end())
            return;
        VolumeFacts volume = s->second.volumes.front();
        readVolume(row, volume);
        if (described.insert(row.integer(1)).second)
            s->second.volumes.clear();
        s->second.volumes.push_back(volume);
    });
    std::vector<LibrarySeries> all;
    for (auto &[id, s] : series)
        if (!s.files.empty() && described.contains(id) && isPlausible(s))
            all.push_back(std::move(s));
        else
            ++lost;
    return all;
}

bool isSound(const QSqlDatabase &list) {
    ListQuery check(list, "PRAGMA quick_check(1)");
    check.run();
    return check.next() && check.text(0) == "ok";
}

fs::path freeName(const LibraryPlace &place) {
    const QString day = QDate::currentDate().toString(Qt::ISODate);
    for (int n = 1;; ++n) {
        const fs::path path =
            place.folder /
            QString("library-damaged-%1-%2.sqlite").arg(day, QString::number(n)).toStdString();
        std::error_code ignored;
        if (!fs::exists(path, ignored))
            return path;
    }
}

struct Found {
    enum class State { sound, damaged, unusable } state;
    std::optional<task::Reason> reason{}; ///< why it is unusable
    std::vector<LibrarySeries> saved{};
    int lost = 0;        ///< number of series in the list that could not be read
    bool isRead = false; ///< false: the number of series is unknown
};

Found inspect(const LibraryPlace &place) {
    Found found{Found::State::damaged};
    bool isOpen = false;
    try {
        const Library library(place);
        const auto connection = QSqlDatabase::database(library.connection());
        if (isSound(connection)) {
            found.state = Found::State::sound;
            return found;
        }
        isOpen = true;
        found.saved = salvage(connection, found.lost);
        found.isRead = !found.saved.empty() || found.lost > 0;
    } catch (const Error &error) {
        // A file that is not a list is damaged; a folder or version that prevents writing is not
        // damage.
        std::error_code unknown;
        const bool isThere = fs::exists(place.listFile(), unknown);
        const bool isList = !error.reason().is(because::libraryIsDamaged);
        if (!isOpen && (!isThere || isList)) {
            found.state = Found::State::unusable;
            found.reason = error.reason();
        }
    }
    return found;
}

// Keeps the damaged list under a free name and replaces it once the new one is complete: if the
// program is killed before, the next one finds the damaged list.
fs::path replaceList(const LibraryPlace &place, const std::vector<LibrarySeries> &saved) {
    const fs::path list = place.listFile(), kept = freeName(place);
    try {
        const auto aside = files::SessionFolder::beside(list);
        const LibraryPlace rebuilt{aside.path()};
        Library(rebuilt).put(saved);
        std::error_code failed;
        fs::create_hard_link(list, kept, failed);
        if (failed) // not every file system supports hard links
            fs::copy_file(list, kept);
        // The journal of the damaged list must not be applied to the new one.
        fs::path undone = list, keptUndone = kept;
        fs::rename(undone += "-journal", keptUndone += "-journal", failed);
        files::AtomicFile mark(place.rebuiltMark());
        mark.commit();
        files::rename(rebuilt.listFile(), list);
    } catch (const fs::filesystem_error &error) {
        throw Error(task::ErrorCode::output, task::systemReason(error.code()), list);
    }
    return kept;
}

// Whether there are copies without a list, as after a power failure. Folders with unlisted files do
// not count: they are there before the first list is.
bool hasCopiesWithoutList(const LibraryPlace &place, const std::vector<fs::path> &unlisted) {
    std::error_code none, failed;
    const auto bytes = fs::file_size(place.listFile(), none);
    if (!none && bytes > 0)
        return false;
    std::set<fs::path> known{place.incomingFolder()};
    for (const fs::path &file : unlisted) {
        const fs::path inside = file.lexically_relative(place.copiesFolder());
        if (!inside.empty())
            known.insert(place.copiesFolder() / *inside.begin());
    }
    for (fs::directory_iterator entry(place.copiesFolder(), failed), end; !failed && entry != end;
         entry.increment(failed))
        if (!known.contains(entry->path()))
            return true;
    return false;
}

OpenedLibrary listInMemory(OpenedLibrary opened, const task::Reason &reason) {
    opened.place.inMemory = true;
    opened.notices.push_back({opened.place.listFile(), because::listedForThisRun(reason)});
    return opened;
}

} // namespace

OpenedLibrary openLibrary(const fs::path &folder, const std::vector<fs::path> &unlisted) {
    OpenedLibrary opened;
    opened.place.folder = folder;
    std::error_code failed;
    fs::create_directories(folder, failed);
    const bool hadNoList = hasCopiesWithoutList(opened.place, unlisted);
    if (hadNoList) {
        try {
            files::AtomicFile(opened.place.rebuiltMark()).commit();
        } catch (const Error &) {
            // This program lists the copies again in any case.
        }
    }
    Found found = inspect(opened.place);
    std::optional<files::FileLock> lock;
    if (found.state == Found::State::damaged) {
        // Another process may be repairing it, or may have repaired it by then.
        lock.emplace(folder / "library.lock");
        found = inspect(opened.place);
    }
    if (found.state == Found::State::unusable)
        return listInMemory(std::move(opened), *found.reason);
    if (found.state == Found::State::damaged) {
        opened.wasDamaged = true;
        try {
            const fs::path kept = replaceList(opened.place, found.saved);
            opened.notices.push_back(
                {kept, found.isRead ? because::libraryWasRebuilt(found.saved.size(), found.lost)
                                    : task::Reason(because::libraryWasNotReadable)});
            system::log("the study library was damaged and has been rebuilt");
        } catch (const Error &error) {
            system::log("the study library is damaged and cannot be rebuilt");
            opened.readable = std::move(found.saved);
            return listInMemory(std::move(opened), because::cannotBeRebuilt(error.reason()));
        }
    }
    if (hadNoList)
        opened.notices.push_back({opened.place.listFile(), because::libraryWasEmpty});
    opened.mayLackCopies = hadNoList || fs::exists(opened.place.rebuiltMark(), failed);
    return opened;
}

} // namespace pellucid::ui
