// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <QDialog>

#include "core/classify/tissue_class.h"
#include "core/measure/measurement.h"
#include "ui/jobs/job_runner.h"

class QPushButton;
class QTableWidget;

namespace pellucid::ui {

class Document;
class PlainLabel;

/// How large the classes of the look are, and which values they have.
class ClassVolumesDialog : public QDialog {
    Q_OBJECT
public:
    /// The document must outlive it.
    ClassVolumesDialog(const Document &document, QWidget *parent);
    ~ClassVolumesDialog() override;

    struct Row {
        std::string name;
        double volumeMm3 = 0.0;
        std::optional<measure::RegionValues> values; ///< none if no sample belongs to the class
    };

signals:
    /// The table was written.
    void saved(const QString &path);
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    void measure();
    void showRows(const std::vector<Row> &rows);
    QString table(QChar separator) const;
    void save();

    const Document &m_document;
    std::vector<classify::TissueClass> m_measured; ///< what the table shows
    QTableWidget *m_table;
    PlainLabel *m_message;
    QPushButton *m_copy, *m_save;
    JobRunner m_jobs; ///< last: its work refers to the others
};

} // namespace pellucid::ui
