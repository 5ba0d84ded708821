// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/list_query.h"

#include <QSqlError>

#include "core/task/error.h"
#include "ui/language/kept_reasons.h"
#include "ui/library/reasons.h"

namespace pellucid::ui {

void failOnList(const QSqlError &error, const std::filesystem::path &path) {
    const std::string message =
        (error.driverText() + " " + error.databaseText()).simplified().toStdString();
    // SQLITE_NOTADB and SQLITE_CORRUPT; the mask removes extended error codes.
    constexpr int notAList = 26, corrupt = 11, plain = 0xff;
    const int code = error.nativeErrorCode().toInt() & plain;
    const bool isDamaged = code == notAList || code == corrupt;
    throw task::Error(task::ErrorCode::output,
                      isDamaged ? task::because::libraryIsDamaged(message)
                                : task::because::ofLibrary(message),
                      path);
}

ListQuery::ListQuery(const QSqlDatabase &list, const QString &text) : m_query(list), m_list(list) {
    // Rows are read once, forwards; caching them would cost time and memory.
    m_query.setForwardOnly(true);
    if (!m_query.prepare(text))
        failOnList(m_query.lastError(), path());
}

std::filesystem::path ListQuery::path() const {
    return m_list.databaseName().toStdString();
}

ListQuery &ListQuery::bind(const QVariant &value) {
    m_query.addBindValue(value);
    return *this;
}

ListQuery &ListQuery::run() {
    if (!m_query.exec())
        failOnList(m_query.lastError(), path());
    return *this;
}

bool ListQuery::next() {
    if (m_query.next())
        return true;
    // An unreadable row must not look like the end of the rows.
    if (m_query.lastError().isValid())
        failOnList(m_query.lastError(), path());
    return false;
}

ListTransaction::ListTransaction(const QSqlDatabase &list) : m_list(list) {
    ListQuery(m_list, "BEGIN IMMEDIATE").run();
}

ListTransaction::~ListTransaction() {
    if (!m_isDone)
        QSqlQuery(m_list).exec("ROLLBACK");
}

void ListTransaction::commit() {
    ListQuery(m_list, "COMMIT").run();
    m_isDone = true;
}

StudyFacts studyOf(const ListQuery &row) {
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
    study.origin = row.integer(9) != 0 ? Origin::volumeFiles : Origin::patient;
    return study;
}

VolumeFacts seriesOf(const ListQuery &row) {
    VolumeFacts v;
    v.seriesUid = row.text(2);
    v.seriesNumber = int(row.integer(3));
    v.modality = row.text(4);
    v.bodyPart = row.text(5);
    v.description = row.text(6);
    return v;
}

void readVolume(const ListQuery &row, VolumeFacts &v) {
    v.libraryId = row.integer(0);
    v.label = reasonsFromLines(row.text(2));
    v.size = {int(row.integer(3)), int(row.integer(4)), int(row.integer(5))};
    v.spacingMm = {row.number(6), row.number(7), row.number(8)};
    v.tiltDeg = row.number(9);
    v.placed = row.integer(10) != 0;
    v.warnings = reasonsFromLines(row.text(11));
    v.file = row.text(12);
    if (!v.file.isEmpty())
        v.seriesUid.clear(); // the column contains the path of the file
    v.thumbnail.loadFromData(row.bytes(13), "PNG");
}

std::vector<dicom::InstanceFile> filesOfSeries(const QSqlDatabase &list, qint64 series) {
    ListQuery rows(list, "SELECT instance, path FROM instances WHERE series = ? ORDER BY instance");
    rows.bind(series).run();
    std::vector<dicom::InstanceFile> files;
    while (rows.next()) {
        const QString instance = rows.text(0), path = rows.text(1);
        files.push_back({path.toStdString(), instance == path ? "" : instance.toStdString()});
    }
    return files;
}

// A volume file has no series UID.
QString seriesKey(const VolumeFacts &volume) {
    return volume.file.isEmpty() ? volume.seriesUid : volume.file;
}

} // namespace pellucid::ui
