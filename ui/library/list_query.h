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

/// *Throws* Error{output} with SQLite's message.
[[noreturn]] void failOnList(const QSqlError &error, const std::filesystem::path &path);

/// A statement on the list of a library. *Throws* Error{output} if it fails, also while its rows
/// are read. It may be run again with different values.
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

/// A transaction: rolled back unless committed.
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

/// The columns of the tables, in the order in which the functions below read them.
inline constexpr const char *studyColumns = "id, patient_id, patient_name, birth_date, sex, uid, "
                                            "date, description, modalities, origin";
StudyFacts studyOf(const ListQuery &row);
inline constexpr const char *seriesColumns =
    "id, study, uid, number, modality, body_part, description";
/// The facts that all volumes of a series share.
VolumeFacts seriesOf(const ListQuery &row);
inline constexpr const char *volumeColumns =
    "id, series, label, columns, rows, slices, column_mm, row_mm, slice_mm, tilt_deg, placed, "
    "warnings, file, thumbnail";
/// Reads a row into `volume`, which already has the facts of its series.
void readVolume(const ListQuery &row, VolumeFacts &volume);
std::vector<dicom::InstanceFile> filesOfSeries(const QSqlDatabase &list, qint64 series);

/// The key of a series: its UID, or the path of a volume that is a single file.
QString seriesKey(const VolumeFacts &volume);

} // namespace pellucid::ui
