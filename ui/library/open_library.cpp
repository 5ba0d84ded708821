// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <system_error>

#include <QCoreApplication>
#include <QDate>

#include "core/task/error.h"
#include "core/task/log.h"
#include "ui/library/library.h"
#include "ui/library/list_query.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;
using task::Error;

struct LibraryTexts {
    Q_DECLARE_TR_FUNCTIONS(LibraryTexts)
};

// Rows are asked for one by one, by their numbers: each way down the tree of pages that is whole
// still leads to its rows, whatever is broken beside it.
void forEachReadableRow(const QSqlDatabase &list, const QString &table, const QString &columns,
                        const std::function<void(const ListQuery &)> &f) {
    qint64 last = 0;
    try {
        ListQuery numbers(list, QString("SELECT max(id) FROM %1").arg(table));
        numbers.run();
        last = numbers.next() ? numbers.integer(0) : 0;
    } catch (const Error &) {
        return; // the root of the tree is gone
    }
    // Numbers beyond what the file could hold are noise.
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
            // On a broken page.
        }
    }
}

std::vector<LibrarySeries> readWhatIsThere(const QSqlDatabase &list, int &lost) {
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
            // Without files there is nothing to keep.
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
        if (!s.files.empty() && described.contains(id))
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
            place.folder / QString("library-damaged-%1-%2.sqlite").arg(day).arg(n).toStdString();
        std::error_code ignored;
        if (!fs::exists(path, ignored))
            return path;
    }
}

// The damaged list stays under a free name, and a new one takes its place when it is whole: whoever
// is killed meanwhile finds the damaged one.
fs::path replaceList(const LibraryPlace &place, const std::vector<LibrarySeries> &saved) {
    const LibraryPlace aside{place.folder / "rebuilt"};
    fs::remove_all(aside.folder);
    fs::create_directories(aside.folder);
    Library(aside).put(saved);
    const fs::path list = place.listFile(), kept = freeName(place);
    std::error_code failed;
    fs::create_hard_link(list, kept, failed);
    if (failed) // not every file system has them
        fs::copy_file(list, kept);
    // What the damaged one had left undone is not the new one's.
    fs::path undone = list, keptUndone = kept;
    fs::rename(undone += "-journal", keptUndone += "-journal", failed);
    fs::rename(aside.listFile(), list);
    fs::remove_all(aside.folder, failed);
    return kept;
}

} // namespace

OpenedLibrary openLibrary(const fs::path &folder) {
    OpenedLibrary opened;
    opened.place.folder = folder;
    std::error_code failed;
    fs::create_directories(folder, failed);
    const auto list = opened.place.listFile();
    std::vector<LibrarySeries> saved;
    int lost = 0;
    try {
        const Library library(opened.place);
        const auto connection = QSqlDatabase::database(library.m_connection);
        if (isSound(connection))
            return opened;
        opened.wasDamaged = true;
        saved = readWhatIsThere(connection, lost);
    } catch (const Error &error) {
        // Not a list at all is damage; a folder or a version that forbids writing is not.
        const bool isThere = fs::exists(list, failed);
        const bool isList = error.reason().find("not a database") == std::string::npos &&
                            error.reason().find("malformed") == std::string::npos;
        if (!opened.wasDamaged && (!isThere || isList)) {
            opened.place.inMemory = true;
            opened.notices.push_back(
                {list,
                 error.reason() +
                     LibraryTexts::tr("; studies are listed for this run only").toStdString()});
            return opened;
        }
        opened.wasDamaged = true;
    }
    try {
        const fs::path kept = replaceList(opened.place, saved);
        opened.notices.push_back(
            {kept,
             LibraryTexts::tr("the study library was damaged: %1 series were read, %2 lost; the "
                              "old file is kept under this name")
                 .arg(saved.size())
                 .arg(lost)
                 .toStdString()});
    } catch (const std::exception &error) {
        opened.place.inMemory = true;
        opened.notices.push_back({list, error.what()});
    }
    task::log("the study library was damaged and has been rebuilt");
    return opened;
}

} // namespace pellucid::ui
