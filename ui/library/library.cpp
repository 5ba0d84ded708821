// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/library.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <system_error>

#include <QBuffer>
#include <QDateTime>
#include <QSqlError>
#include <QVariant>

#include "core/files/is_below.h"
#include "core/task/error.h"
#include "ui/language/kept_reasons.h"
#include "ui/library/list_query.h"
#include "ui/library/reasons.h"
#include "ui/studies/search_words.h"

namespace pellucid::ui {

namespace {

namespace fs = std::filesystem;
using task::Error;
using task::ErrorCode;

constexpr int schemaVersion = 3;
// Another window of the program may be writing.
constexpr int busyTimeoutMs = 5000;
constexpr int maxSortedMatches = 2000;

// `search` is the folded text to search in; `instance` distinguishes copies of one instance.
constexpr const char *schema[] = {
    "CREATE TABLE studies (id INTEGER PRIMARY KEY, patient_id TEXT NOT NULL, "
    "patient_name TEXT NOT NULL, birth_date TEXT NOT NULL, sex TEXT NOT NULL, uid TEXT NOT NULL, "
    "date TEXT NOT NULL, description TEXT NOT NULL, modalities TEXT NOT NULL, "
    "sort_name TEXT NOT NULL, search TEXT NOT NULL, added INTEGER NOT NULL, "
    "origin INTEGER NOT NULL, "
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
    ("CREATE TABLE instances (series INTEGER NOT NULL REFERENCES series ON DELETE CASCADE, "
     "instance TEXT NOT NULL, path TEXT NOT NULL, PRIMARY KEY (series, instance)) WITHOUT ROWID")};

// Qt binds a null string as NULL, which the columns do not allow.
QVariant notNull(const QString &text) {
    return text.isNull() ? QString("") : text;
}

qint64 versionOf(const QSqlDatabase &list) {
    ListQuery row(list, "PRAGMA user_version");
    row.run();
    return row.next() ? row.integer(0) : 0;
}

void setVersion(const QSqlDatabase &list) {
    ListQuery(list, QString("PRAGMA user_version = %1").arg(schemaVersion)).run();
}

// A connection can be removed only if no object uses it.
void close(QSqlDatabase &&list, const QString &connection) {
    list.close();
    list = QSqlDatabase();
    QSqlDatabase::removeDatabase(connection);
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
    ListQuery found(list, "SELECT id FROM studies WHERE patient_id = ? AND patient_name = ? AND "
                          "uid = ?");
    found.bind(notNull(study.patientId))
        .bind(notNull(study.patientName))
        .bind(notNull(study.uid))
        .run();
    return found.next() ? found.integer(0) : 0;
}

qint64 findSeries(const QSqlDatabase &list, const StudyFacts &study, const VolumeFacts &volume) {
    ListQuery row(list, "SELECT id FROM series WHERE study = ? AND uid = ?");
    row.bind(findStudy(list, study)).bind(notNull(seriesKey(volume))).run();
    return row.next() ? row.integer(0) : 0;
}

qint64 putStudy(const QSqlDatabase &list, const StudyFacts &s) {
    qint64 id = findStudy(list, s);
    if (id == 0) {
        ListQuery added(
            list, "INSERT INTO studies (patient_id, patient_name, birth_date, sex, uid, "
                  "date, description, modalities, sort_name, search, added, origin) VALUES (?, "
                  "?, ?, ?, ?, ?, ?, '', ?, '', ?, ?)");
        id = added.bind(notNull(s.patientId))
                 .bind(notNull(s.patientName))
                 .bind(notNull(s.birthDate))
                 .bind(notNull(s.sex))
                 .bind(notNull(s.uid))
                 .bind(notNull(s.date))
                 .bind(notNull(s.description))
                 .bind(folded(patientText(s)))
                 .bind(QDateTime::currentMSecsSinceEpoch())
                 .bind(int(s.origin == Origin::volumeFiles))
                 .run()
                 .lastId();
    }
    return id;
}

void putSeries(const QSqlDatabase &list, qint64 study, const LibrarySeries &s) {
    const VolumeFacts &first = s.volumes.front();
    ListQuery(list, "DELETE FROM series WHERE study = ? AND uid = ?")
        .bind(study)
        .bind(notNull(seriesKey(first)))
        .run();
    const qint64 id =
        ListQuery(list, "INSERT INTO series (study, uid, number, modality, body_part, "
                        "description) VALUES (?, ?, ?, ?, ?, ?)")
            .bind(study)
            .bind(notNull(seriesKey(first)))
            .bind(first.seriesNumber)
            .bind(notNull(first.modality))
            .bind(notNull(first.bodyPart))
            .bind(notNull(first.description))
            .run()
            .lastId();
    for (const VolumeFacts &v : s.volumes)
        ListQuery(list,
                  "INSERT INTO volumes (series, label, columns, rows, slices, column_mm, row_mm, "
                  "slice_mm, tilt_deg, placed, warnings, file, thumbnail) VALUES (?, ?, ?, ?, ?, "
                  "?, ?, ?, ?, ?, ?, ?, ?)")
            .bind(id)
            .bind(notNull(toLines(v.label)))
            .bind(v.size.i)
            .bind(v.size.j)
            .bind(v.size.k)
            .bind(v.spacingMm.x)
            .bind(v.spacingMm.y)
            .bind(v.spacingMm.z)
            .bind(v.tiltDeg)
            .bind(v.placed)
            .bind(notNull(toLines(v.warnings)))
            .bind(notNull(v.file))
            .bind(png(v.thumbnail))
            .run();
    // Prepared once: a series has hundreds of instances.
    ListQuery instance(
        list, "INSERT OR REPLACE INTO instances (series, instance, path) VALUES (?, ?, ?)");
    for (const dicom::InstanceFile &file : s.files) {
        const QString path = QString::fromStdString(file.path.string());
        instance.bind(id)
            .bind(file.sopInstanceUid.empty() ? path : QString::fromStdString(file.sopInstanceUid))
            .bind(path)
            .run();
    }
}

// Removes a series from other studies if all its files are in this one: an archive has corrected
// the patient or the study that they name. *Returns* these studies.
std::vector<qint64> removeFormer(const QSqlDatabase &list, qint64 study, const QString &uid) {
    ListQuery rows(
        list,
        "SELECT id, study FROM series WHERE uid = ? AND study <> ? AND EXISTS (SELECT 1 FROM "
        "instances WHERE series = series.id) AND NOT EXISTS (SELECT 1 FROM instances WHERE "
        "series = series.id AND path NOT IN (SELECT path FROM instances WHERE series = (SELECT "
        "id FROM series WHERE uid = ? AND study = ?)))");
    rows.bind(uid).bind(study).bind(uid).bind(study).run();
    std::vector<qint64> series, studies;
    while (rows.next()) {
        series.push_back(rows.integer(0));
        studies.push_back(rows.integer(1));
    }
    for (const qint64 id : series)
        ListQuery(list, "DELETE FROM series WHERE id = ?").bind(id).run();
    for (const qint64 id : studies)
        ListQuery(list, "DELETE FROM studies WHERE id = ? AND NOT EXISTS (SELECT 1 FROM series "
                        "WHERE study = studies.id)")
            .bind(id)
            .run();
    return studies;
}

// Updates the modalities and the search text of a study, which depend on its series.
void describeStudy(const QSqlDatabase &list, qint64 id) {
    ListQuery row(list, QString("SELECT %1 FROM studies WHERE id = ?").arg(studyColumns));
    row.bind(id).run();
    if (!row.next())
        return;
    const StudyFacts study = studyOf(row);
    QStringList modalities, terms{study.patientId, patientText(study), study.date,
                                  dateText(study.date), study.description};
    ListQuery series(list, "SELECT modality, body_part, description FROM series WHERE study = ? "
                           "ORDER BY number");
    series.bind(id).run();
    while (series.next()) {
        if (!series.text(0).isEmpty() && !modalities.contains(series.text(0)))
            modalities << series.text(0);
        terms << series.text(1) << series.text(2);
    }
    terms << modalities;
    terms.removeDuplicates();
    ListQuery(list, "UPDATE studies SET modalities = ?, search = ? WHERE id = ?")
        .bind(modalities.isEmpty() ? QString("") : modalities.join(' '))
        .bind(folded(terms.join('\n')))
        .bind(id)
        .run();
}

} // namespace

Library::Library(const LibraryPlace &place) : m_place(place) {
    static std::atomic<int> number = 0;
    m_connection = QString("library-%1").arg(++number);
    QSqlDatabase list = QSqlDatabase::addDatabase("QSQLITE", m_connection);
    QString options = QString("QSQLITE_BUSY_TIMEOUT=%1").arg(busyTimeoutMs);
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
        failOnList(error, place.listFile());
    }
    try {
        ListQuery(list, "PRAGMA foreign_keys = ON").run();
        if (versionOf(list) == 0) {
            ListTransaction transaction(list);
            // Another window may have created it while this one waited.
            if (versionOf(list) == 0) {
                for (const char *statement : schema)
                    ListQuery(list, statement).run();
                setVersion(list);
            }
            transaction.commit();
        }
        if (versionOf(list) != schemaVersion)
            throw Error(ErrorCode::output, task::because::isALibraryOfAnotherVersion,
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
    ListQuery number(list, "SELECT count(*) FROM studies" + matching);
    for (const QString &term : terms)
        number.bind(term);
    number.run();
    page.count = number.next() ? int(number.integer(0)) : 0;
    // With many matches, walking the index fills a page soonest. With few, scanning the table and
    // sorting is faster: the plus sign prevents use of the index.
    const bool isAlongIndex = page.count > maxSortedMatches || terms.isEmpty();
    ListQuery rows(list, QString("SELECT %1 FROM studies").arg(studyColumns) + matching +
                             QString(orderText(order)).arg(isAlongIndex ? "" : "+") +
                             " LIMIT ? OFFSET ?");
    for (const QString &term : terms)
        rows.bind(term);
    rows.bind(limit).bind(offset).run();
    while (rows.next())
        page.studies.push_back(studyOf(rows));
    return page;
}

bool Library::contains(const StudyFacts &study, const VolumeFacts &volume) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    return findSeries(list, study, volume) != 0;
}

std::optional<StudyFacts> Library::study(qint64 id) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    ListQuery row(list, QString("SELECT %1 FROM studies WHERE id = ?").arg(studyColumns));
    row.bind(id).run();
    return row.next() ? std::optional(studyOf(row)) : std::nullopt;
}

std::vector<VolumeFacts> Library::volumes(const StudyFacts &study) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    const fs::path copies = m_place.copiesFolder();
    std::vector<VolumeFacts> volumes;
    ListQuery series(
        list,
        QString("SELECT %1 FROM series WHERE study = ? ORDER BY number, id").arg(seriesColumns));
    series.bind(findStudy(list, study)).run();
    while (series.next()) {
        VolumeFacts seriesFacts = seriesOf(series);
        ListQuery files(list, "SELECT count(*), min(path) FROM instances WHERE series = ?");
        files.bind(series.integer(0)).run();
        if (files.next()) {
            seriesFacts.files = int(files.integer(0));
            seriesFacts.isCopied = files::isBelow(files.text(1).toStdString(), copies);
        }
        ListQuery rows(
            list,
            QString("SELECT %1 FROM volumes WHERE series = ? ORDER BY id").arg(volumeColumns));
        rows.bind(series.integer(0)).run();
        while (rows.next()) {
            volumes.push_back(seriesFacts);
            readVolume(rows, volumes.back());
        }
    }
    return volumes;
}

std::vector<dicom::InstanceFile> Library::files(const StudyFacts &study,
                                                const VolumeFacts &volume) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    const qint64 series = findSeries(list, study, volume);
    return series != 0 ? filesOfSeries(list, series) : std::vector<dicom::InstanceFile>();
}

void Library::put(const std::vector<LibrarySeries> &series) {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    ListTransaction transaction(list);
    std::vector<qint64> touched;
    for (const LibrarySeries &s : series) {
        if (s.volumes.empty())
            continue;
        const qint64 study = putStudy(list, s.study);
        putSeries(list, study, s);
        if (touched.empty() || touched.back() != study)
            touched.push_back(study);
    }
    if (!touched.empty())
        ListQuery(list, "CREATE INDEX IF NOT EXISTS series_by_uid ON series (uid)").run();
    for (const LibrarySeries &s : series)
        if (!s.volumes.empty())
            for (const qint64 former :
                 removeFormer(list, findStudy(list, s.study),
                              notNull(seriesKey(s.volumes.front())).toString()))
                touched.push_back(former);
    for (const qint64 study : touched)
        describeStudy(list, study);
    transaction.commit();
}

std::vector<fs::path> Library::copiesOf(const StudyFacts &study) const {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    ListQuery rows(list, "SELECT path FROM instances WHERE series IN (SELECT id FROM series WHERE "
                         "study = ?)");
    rows.bind(findStudy(list, study)).run();
    std::vector<fs::path> own;
    while (rows.next())
        if (fs::path path = rows.text(0).toStdString();
            files::isBelow(path, m_place.copiesFolder()))
            own.push_back(std::move(path));
    return own;
}

void Library::remove(const StudyFacts &study) {
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    ListQuery(list, "DELETE FROM studies WHERE id = ?").bind(findStudy(list, study)).run();
}

void Library::removeCopies(const std::vector<fs::path> &copies) {
    if (copies.empty())
        return;
    const QSqlDatabase list = QSqlDatabase::database(m_connection);
    std::set<fs::path> used;
    ListQuery rows(list, "SELECT path FROM instances");
    rows.run();
    while (rows.next())
        if (fs::path path = rows.text(0).toStdString();
            files::isBelow(path, m_place.copiesFolder()))
            used.insert(std::move(path));
    for (const fs::path &path : copies) {
        if (used.contains(path))
            continue;
        std::error_code ignored;
        fs::remove(path, ignored);
        fs::remove(path.parent_path(), ignored); // succeeds only if it is empty
    }
}

} // namespace pellucid::ui
