// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/library.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <set>
#include <system_error>

#include <QBuffer>
#include <QCoreApplication>
#include <QDateTime>
#include <QSqlDatabase>
#include <QSqlError>
#include <QSqlQuery>
#include <QVariant>

#include "core/task/error.h"
#include "core/task/log.h"
#include "ui/library/search_words.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

constexpr int schemaVersion = 1;
// Another window of the program may be writing.
constexpr int patienceMs = 5000;
constexpr int fewMatches = 2000;

// `search` is what is searched in, folded; `instance` tells copies of one instance apart.
constexpr const char *schema[] = {
    "CREATE TABLE studies (id INTEGER PRIMARY KEY, patient_id TEXT NOT NULL, "
    "patient_name TEXT NOT NULL, birth_date TEXT NOT NULL, sex TEXT NOT NULL, uid TEXT NOT NULL, "
    "date TEXT NOT NULL, description TEXT NOT NULL, modalities TEXT NOT NULL, "
    "sort_name TEXT NOT NULL, search TEXT NOT NULL, added INTEGER NOT NULL, "
    "UNIQUE (patient_id, patient_name, uid))",
    "CREATE INDEX studies_by_date ON studies (date DESC, sort_name)",
    "CREATE INDEX studies_by_name ON studies (sort_name, date DESC)",
    "CREATE INDEX studies_by_added ON studies (added DESC)",
    "CREATE TABLE series (id INTEGER PRIMARY KEY, "
    "study INTEGER NOT NULL REFERENCES studies ON DELETE CASCADE, uid TEXT NOT NULL, "
    "number INTEGER NOT NULL, modality TEXT NOT NULL, body_part TEXT NOT NULL, "
    "description TEXT NOT NULL, UNIQUE (study, uid))",
    "CREATE TABLE volumes (id INTEGER PRIMARY KEY, "
    "series INTEGER NOT NULL REFERENCES series ON DELETE CASCADE, label TEXT NOT NULL, "
    "columns INTEGER NOT NULL, rows INTEGER NOT NULL, slices INTEGER NOT NULL, "
    "column_mm REAL NOT NULL, row_mm REAL NOT NULL, slice_mm REAL NOT NULL, "
    "tilt_deg REAL NOT NULL, placed INTEGER NOT NULL, warnings TEXT NOT NULL, "
    "file TEXT NOT NULL, thumbnail BLOB)",
    "CREATE INDEX volumes_by_series ON volumes (series)",
    "CREATE TABLE instances (series INTEGER NOT NULL REFERENCES series ON DELETE CASCADE, "
    "instance TEXT NOT NULL, path TEXT NOT NULL, PRIMARY KEY (series, instance)) WITHOUT ROWID"};

struct LibraryTexts {
    Q_DECLARE_TR_FUNCTIONS(LibraryTexts)
};

std::string pathText(const QString &text) {
    return text.toStdString();
}

[[noreturn]] void fail(const QSqlError &error, const fs::path &path) {
    const QString reason = error.driverText() + " " + error.databaseText();
    throw Error(ErrorCode::output, "the study library: " + reason.simplified().toStdString(), path);
}

class Query {
public:
    Query(const QSqlDatabase &list, const QString &text) : m_query(list), m_list(list) {
        // Rows are read once and forwards; keeping them would cost twice.
        m_query.setForwardOnly(true);
        if (!m_query.prepare(text))
            fail(m_query.lastError(), pathText(m_list.databaseName()));
    }
    Query &bind(const QVariant &value) {
        m_query.addBindValue(value);
        return *this;
    }
    Query &run() {
        if (!m_query.exec())
            fail(m_query.lastError(), pathText(m_list.databaseName()));
        return *this;
    }
    bool next() {
        if (m_query.next())
            return true;
        // Rows that cannot be read are not rows that are not there.
        if (m_query.lastError().isValid())
            fail(m_query.lastError(), pathText(m_list.databaseName()));
        return false;
    }
    QString text(int column) const { return m_query.value(column).toString(); }
    qint64 integer(int column) const { return m_query.value(column).toLongLong(); }
    double number(int column) const { return m_query.value(column).toDouble(); }
    QByteArray bytes(int column) const { return m_query.value(column).toByteArray(); }
    qint64 lastId() const { return m_query.lastInsertId().toLongLong(); }

private:
    QSqlQuery m_query;
    QSqlDatabase m_list;
};

// SQLite takes no empty value for "text without letters" where there is no string at all.
QVariant said(const QString &text) {
    return text.isNull() ? QString("") : text;
}

class Transaction {
public:
    explicit Transaction(QSqlDatabase list) : m_list(std::move(list)) {
        Query(m_list, "BEGIN IMMEDIATE").run();
    }
    ~Transaction() {
        if (!m_isDone)
            QSqlQuery(m_list).exec("ROLLBACK");
    }
    void commit() {
        Query(m_list, "COMMIT").run();
        m_isDone = true;
    }

private:
    QSqlDatabase m_list;
    bool m_isDone = false;
};

// A connection may be taken away only when nobody holds it.
void close(QSqlDatabase &&list, const QString &connection) {
    list.close();
    list = QSqlDatabase();
    QSqlDatabase::removeDatabase(connection);
}

constexpr const char *studyColumns = "id, patient_id, patient_name, birth_date, sex, uid, date, "
                                     "description, modalities";

StudyFacts studyOf(const Query &row) {
    StudyFacts study;
    study.libraryId = row.integer(0);
    study.patientId = row.text(1);
    study.patientName = row.text(2);
    study.birthDate = row.text(3);
    study.sex = row.text(4);
    study.uid = row.text(5);
    study.date = row.text(6);
    study.description = row.text(7);
    study.modalities = row.text(8);
    return study;
}

// What a series says of all of its volumes.
constexpr const char *seriesColumns = "id, study, uid, number, modality, body_part, description";

VolumeFacts seriesOf(const Query &row) {
    VolumeFacts v;
    v.seriesUid = row.text(2);
    v.seriesNumber = int(row.integer(3));
    v.modality = row.text(4);
    v.bodyPart = row.text(5);
    v.description = row.text(6);
    return v;
}

constexpr const char *volumeColumns =
    "id, series, label, columns, rows, slices, column_mm, row_mm, slice_mm, tilt_deg, placed, "
    "warnings, file, thumbnail";

void readVolume(const Query &row, VolumeFacts &v) {
    v.libraryId = row.integer(0);
    v.label = row.text(2);
    v.size = {int(row.integer(3)), int(row.integer(4)), int(row.integer(5))};
    v.spacingMm = {row.number(6), row.number(7), row.number(8)};
    v.tiltDeg = row.number(9);
    v.placed = row.integer(10) != 0;
    v.warnings = row.text(11).split('\n', Qt::SkipEmptyParts);
    v.file = row.text(12);
    if (!v.file.isEmpty())
        v.seriesUid.clear(); // there it stands for the file
    v.thumbnail.loadFromData(row.bytes(13), "PNG");
}

std::vector<dicom::InstanceFile> filesOfSeries(const QSqlDatabase &list, qint64 series) {
    Query rows(list, "SELECT instance, path FROM instances WHERE series = ? ORDER BY instance");
    rows.bind(series).run();
    std::vector<dicom::InstanceFile> files;
    while (rows.next()) {
        const QString instance = rows.text(0), path = rows.text(1);
        files.push_back({path.toStdString(), instance == path ? "" : instance.toStdString()});
    }
    return files;
}

QByteArray png(const QImage &image) {
    QByteArray bytes;
    if (!image.isNull()) {
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        image.save(&buffer, "PNG");
    }
    return bytes;
}

// The volumes of one file have no series of their own.
QString seriesKey(const VolumeFacts &volume) {
    return volume.file.isEmpty() ? volume.seriesUid : volume.file;
}

QString condition(int words) {
    return words == 0 ? QString()
                      : " WHERE " + QStringList(words, "instr(search, ?) > 0").join(" AND ");
}

const char *orderText(StudyOrder order) {
    switch (order) {
    case StudyOrder::newestFirst:
        return " ORDER BY %1date DESC, sort_name";
    case StudyOrder::byName:
        return " ORDER BY %1sort_name, date DESC";
    case StudyOrder::lastAddedFirst:
        break;
    }
    return " ORDER BY %1added DESC";
}

qint64 findStudy(const QSqlDatabase &list, const StudyFacts &study) {
    Query found(list, "SELECT id FROM studies WHERE patient_id = ? AND patient_name = ? AND "
                      "uid = ?");
    found.bind(said(study.patientId)).bind(said(study.patientName)).bind(said(study.uid)).run();
    return found.next() ? found.integer(0) : 0;
}

qint64 findSeries(const QSqlDatabase &list, const StudyFacts &study, const VolumeFacts &volume) {
    Query row(list, "SELECT id FROM series WHERE study = ? AND uid = ?");
    row.bind(findStudy(list, study)).bind(said(seriesKey(volume))).run();
    return row.next() ? row.integer(0) : 0;
}

qint64 putStudy(const QSqlDatabase &list, const StudyFacts &s) {
    qint64 id = findStudy(list, s);
    if (id == 0) {
        Query added(list, "INSERT INTO studies (patient_id, patient_name, birth_date, sex, uid, "
                          "date, description, modalities, sort_name, search, added) VALUES (?, ?, "
                          "?, ?, ?, ?, ?, '', ?, '', ?)");
        id = added.bind(said(s.patientId))
                 .bind(said(s.patientName))
                 .bind(said(s.birthDate))
                 .bind(said(s.sex))
                 .bind(said(s.uid))
                 .bind(said(s.date))
                 .bind(said(s.description))
                 .bind(folded(patientText(s)))
                 .bind(QDateTime::currentMSecsSinceEpoch())
                 .run()
                 .lastId();
    }
    return id;
}

void putSeries(const QSqlDatabase &list, qint64 study, const LibrarySeries &s) {
    const VolumeFacts &first = s.volumes.front();
    Query(list, "DELETE FROM series WHERE study = ? AND uid = ?")
        .bind(study)
        .bind(said(seriesKey(first)))
        .run();
    const qint64 id = Query(list, "INSERT INTO series (study, uid, number, modality, body_part, "
                                  "description) VALUES (?, ?, ?, ?, ?, ?)")
                          .bind(study)
                          .bind(said(seriesKey(first)))
                          .bind(first.seriesNumber)
                          .bind(said(first.modality))
                          .bind(said(first.bodyPart))
                          .bind(said(first.description))
                          .run()
                          .lastId();
    for (const VolumeFacts &v : s.volumes)
        Query(list, "INSERT INTO volumes (series, label, columns, rows, slices, column_mm, row_mm, "
                    "slice_mm, tilt_deg, placed, warnings, file, thumbnail) VALUES (?, ?, ?, ?, ?, "
                    "?, ?, ?, ?, ?, ?, ?, ?)")
            .bind(id)
            .bind(said(v.label))
            .bind(v.size.i)
            .bind(v.size.j)
            .bind(v.size.k)
            .bind(v.spacingMm.x)
            .bind(v.spacingMm.y)
            .bind(v.spacingMm.z)
            .bind(v.tiltDeg)
            .bind(v.placed)
            .bind(said(v.warnings.join('\n')))
            .bind(said(v.file))
            .bind(png(v.thumbnail))
            .run();
    // Prepared once: a series has hundreds.
    Query instance(list,
                   "INSERT OR REPLACE INTO instances (series, instance, path) VALUES (?, ?, ?)");
    for (const dicom::InstanceFile &file : s.files) {
        const QString path = QString::fromStdString(file.path.string());
        instance.bind(id)
            .bind(file.sopInstanceUid.empty() ? path : QString::fromStdString(file.sopInstanceUid))
            .bind(path)
            .run();
    }
}

// What a study is found by changes with its series.
void describeStudy(const QSqlDatabase &list, qint64 id) {
    Query row(list, QString("SELECT %1 FROM studies WHERE id = ?").arg(studyColumns));
    row.bind(id).run();
    if (!row.next())
        return;
    const StudyFacts study = studyOf(row);
    QStringList modalities, said{study.patientId, patientText(study), study.date,
                                 dateText(study.date), study.description};
    Query series(list, "SELECT modality, body_part, description FROM series WHERE study = ? "
                       "ORDER BY number");
    series.bind(id).run();
    while (series.next()) {
        if (!series.text(0).isEmpty() && !modalities.contains(series.text(0)))
            modalities << series.text(0);
        said << series.text(1) << series.text(2);
    }
    said << modalities;
    said.removeDuplicates();
    Query(list, "UPDATE studies SET modalities = ?, search = ? WHERE id = ?")
        .bind(modalities.isEmpty() ? QString("") : modalities.join(' '))
        .bind(folded(said.join('\n')))
        .bind(id)
        .run();
}

} // namespace

Library::Library(const LibraryPlace &place) : m_place(place) {
    static std::atomic<int> number = 0;
    m_connection = QString("library-%1").arg(++number);
    QSqlDatabase list = QSqlDatabase::addDatabase("QSQLITE", m_connection);
    QString options = QString("QSQLITE_BUSY_TIMEOUT=%1").arg(patienceMs);
    if (place.inMemory) {
        list.setDatabaseName("file:pellucid-library?mode=memory&cache=shared");
        options += ";QSQLITE_OPEN_URI";
    } else {
        list.setDatabaseName(QString::fromStdString(place.listFile().string()));
    }
    list.setConnectOptions(options);
    if (!list.open()) {
        const QSqlError error = list.lastError();
        close(std::move(list), m_connection);
        fail(error, place.listFile());
    }
    try {
        Query(list, "PRAGMA foreign_keys = ON").run();
        const auto version = [&] {
            Query row(list, "PRAGMA user_version");
            row.run();
            return row.next() ? row.integer(0) : 0;
        };
        if (version() == 0) {
            Transaction making(list);
            // Another window may have made it while this one waited.
            if (version() == 0) {
                for (const char *statement : schema)
                    Query(list, statement).run();
                Query(list, QString("PRAGMA user_version = %1").arg(schemaVersion)).run();
            }
            making.commit();
        }
        if (version() > schemaVersion)
            throw Error(ErrorCode::output, "is a study library of a newer version",
                        place.listFile());
    } catch (const Error &) {
        close(std::move(list), m_connection);
        throw;
    }
}

Library::~Library() {
    close(QSqlDatabase::database(m_connection, false), m_connection);
}

StudyPage Library::find(const QString &search, StudyOrder order, int offset, int limit) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    const QStringList terms = searchWords(search);
    const QString matching = condition(int(terms.size()));
    StudyPage page;
    Query number(list, "SELECT count(*) FROM studies" + matching);
    for (const QString &term : terms)
        number.bind(term);
    number.run();
    page.count = number.next() ? int(number.integer(0)) : 0;
    // Many matches are soon met along the index; few are found by one way through the table and
    // sorted, which the plus sign asks for.
    const bool isAlongIndex = page.count > fewMatches || terms.isEmpty();
    Query rows(list, QString("SELECT %1 FROM studies").arg(studyColumns) + matching +
                         QString(orderText(order)).arg(isAlongIndex ? "" : "+") +
                         " LIMIT ? OFFSET ?");
    for (const QString &term : terms)
        rows.bind(term);
    rows.bind(limit).bind(offset).run();
    while (rows.next())
        page.studies.push_back(studyOf(rows));
    return page;
}

bool Library::holds(const StudyFacts &study, const VolumeFacts &volume) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    return findSeries(list, study, volume) != 0;
}

std::vector<VolumeFacts> Library::volumes(qint64 study) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    const std::string copies = m_place.copiesFolder().string() + "/";
    std::vector<VolumeFacts> volumes;
    Query series(
        list,
        QString("SELECT %1 FROM series WHERE study = ? ORDER BY number, id").arg(seriesColumns));
    series.bind(study).run();
    while (series.next()) {
        VolumeFacts ofSeries = seriesOf(series);
        Query files(list, "SELECT count(*), min(path) FROM instances WHERE series = ?");
        files.bind(series.integer(0)).run();
        if (files.next()) {
            ofSeries.files = int(files.integer(0));
            ofSeries.isCopied = files.text(1).toStdString().starts_with(copies);
        }
        Query rows(
            list,
            QString("SELECT %1 FROM volumes WHERE series = ? ORDER BY id").arg(volumeColumns));
        rows.bind(series.integer(0)).run();
        while (rows.next()) {
            volumes.push_back(ofSeries);
            readVolume(rows, volumes.back());
        }
    }
    return volumes;
}

std::vector<dicom::InstanceFile> Library::files(qint64 volume) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    Query row(list, "SELECT series FROM volumes WHERE id = ?");
    row.bind(volume).run();
    return row.next() ? filesOfSeries(list, row.integer(0)) : std::vector<dicom::InstanceFile>();
}

std::vector<dicom::InstanceFile> Library::files(const StudyFacts &study,
                                                const VolumeFacts &volume) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    const qint64 series = findSeries(list, study, volume);
    return series != 0 ? filesOfSeries(list, series) : std::vector<dicom::InstanceFile>();
}

void Library::put(const std::vector<LibrarySeries> &series) {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    Transaction putting(list);
    std::vector<qint64> touched;
    for (const LibrarySeries &s : series) {
        if (s.volumes.empty())
            continue;
        const qint64 study = putStudy(list, s.study);
        putSeries(list, study, s);
        if (touched.empty() || touched.back() != study)
            touched.push_back(study);
    }
    for (const qint64 study : touched)
        describeStudy(list, study);
    putting.commit();
}

void Library::remove(qint64 study) {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    Query rows(list, "SELECT path FROM instances WHERE series IN (SELECT id FROM series WHERE "
                     "study = ?)");
    rows.bind(study).run();
    const std::string copies = m_place.copiesFolder().string() + "/";
    std::vector<fs::path> own;
    while (rows.next())
        if (const std::string path = rows.text(0).toStdString(); path.starts_with(copies))
            own.emplace_back(path);
    Query(list, "DELETE FROM studies WHERE id = ?").bind(study).run();
    // After the list: files without a row are litter, a row without files is a broken promise.
    for (const fs::path &path : own) {
        std::error_code ignored;
        fs::remove(path, ignored);
        fs::remove(path.parent_path(), ignored); // when it was the last
    }
}

namespace {

// Rows are asked for one by one, by their numbers: each way down the tree of pages that is whole
// still leads to its rows, whatever is broken beside it.
void forEachReadableRow(const QSqlDatabase &list, const QString &table, const QString &columns,
                        const std::function<void(const Query &)> &f) {
    qint64 last = 0;
    try {
        Query numbers(list, QString("SELECT max(id) FROM %1").arg(table));
        numbers.run();
        last = numbers.next() ? numbers.integer(0) : 0;
    } catch (const Error &) {
        return; // the root of the tree is gone
    }
    // Numbers beyond what the file could hold are noise.
    std::error_code unknown;
    const auto bytes = fs::file_size(pathText(list.databaseName()), unknown);
    if (!unknown)
        last = std::min(last, qint64(bytes));
    Query row(list, QString("SELECT %1 FROM %2 WHERE id = ?").arg(columns, table));
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

} // namespace

std::vector<LibrarySeries> Library::readWhatIsThere(int &lost) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    std::map<qint64, StudyFacts> studies;
    forEachReadableRow(list, "studies", studyColumns,
                       [&](const Query &row) { studies[row.integer(0)] = studyOf(row); });
    std::map<qint64, LibrarySeries> series;
    forEachReadableRow(list, "series", seriesColumns, [&](const Query &row) {
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
    forEachReadableRow(list, "volumes", volumeColumns, [&](const Query &row) {
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

namespace {

bool isSound(const QSqlDatabase &list) {
    Query check(list, "PRAGMA quick_check(1)");
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
        if (isSound(QSqlDatabase::database(library.m_connection)))
            return opened;
        opened.wasDamaged = true;
        saved = library.readWhatIsThere(lost);
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
    const fs::path kept = freeName(opened.place);
    try {
        fs::rename(list, kept);
        Library(opened.place).put(saved);
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
