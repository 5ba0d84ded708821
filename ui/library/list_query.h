// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QVariant>

#include "core/dicom/catalogue.h"
#include "ui/studies/study_facts.h"

class QSqlError;

namespace pellucid::ui {

/// *Throws* Error{output} with what SQLite says.
[[noreturn]] void failOnList(const QSqlError &error, const std::filesystem::path &path);

/// A statement on the list of a library that *throws* Error{output} where it fails, while its rows
/// are read too. It may be run again with other values.
class ListQuery {
public:
    ListQuery(const QSqlDatabase &list, const QString &text);
    ListQuery &bind(const QVariant &value);
    ListQuery &run();
    bool next();
    QString text(int column) const { return m_query.value(column).toString(); }
    qint64 integer(int column) const { return m_query.value(column).toLongLong(); }
    double number(int column) const { return m_query.value(column).toDouble(); }
    QByteArray bytes(int column) const { return m_query.value(column).toByteArray(); }
    qint64 lastId() const { return m_query.lastInsertId().toLongLong(); }

private:
    std::filesystem::path path() const;

    QSqlQuery m_query;
    QSqlDatabase m_list;
};

/// All of it or nothing.
class ListTransaction {
public:
    explicit ListTransaction(const QSqlDatabase &list);
    ~ListTransaction();
    ListTransaction(const ListTransaction &) = delete;
    ListTransaction &operator=(const ListTransaction &) = delete;
    void commit();

private:
    QSqlDatabase m_list;
    bool m_isDone = false;
};

/// What stands in the rows of the tables, by columns in this order.
inline constexpr const char *studyColumns = "id, patient_id, patient_name, birth_date, sex, uid, "
                                            "date, description, modalities";
StudyFacts studyOf(const ListQuery &row);
inline constexpr const char *seriesColumns =
    "id, study, uid, number, modality, body_part, description";
/// What a series says of all of its volumes.
VolumeFacts seriesOf(const ListQuery &row);
inline constexpr const char *volumeColumns =
    "id, series, label, columns, rows, slices, column_mm, row_mm, slice_mm, tilt_deg, placed, "
    "warnings, file, thumbnail";
/// `volume`: of its series already.
void readVolume(const ListQuery &row, VolumeFacts &volume);
std::vector<dicom::InstanceFile> filesOfSeries(const QSqlDatabase &list, qint64 series);

/// What a series is kept under: its UID, or the file of a volume that is one file.
QString seriesKey(const VolumeFacts &volume);

} // namespace pellucid::ui
