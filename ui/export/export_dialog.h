// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <QDialog>

#include "core/dicom/catalogue.h"
#include "core/task/reason.h"
#include "ui/export/picture_export.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace pellucid::ui {

class JobRunner;

/// Which pane, in which format and size, with or without annotations, and where to. What cannot be
/// written is said before, what could not be stays in the dialog. Writing is a job: the dialog
/// closes when it is done, and closing it earlier cancels it.
class ExportDialog : public QDialog {
    Q_OBJECT
public:
    ExportDialog(const Document &document, const Panes &panes, JobRunner &jobs,
                 QWidget *parent = nullptr);
    ~ExportDialog() override;

signals:
    void written(const QString &path);
    /// A capture belongs to the study, and into its list.
    void captured(const std::shared_ptr<const pellucid::dicom::Catalogue> &capture);

private:
    PictureExport chosen() const;
    /// Asks before what is there is lost.
    bool mayReplace(const QString &path);
    void showChosen();
    void browse();
    void write();
    void say(const QString &text, const char *role);

    const Document &m_document;
    Panes m_panes;
    JobRunner &m_jobs;
    QComboBox *m_pane, *m_format, *m_scale;
    QCheckBox *m_annotated, *m_deidentified;
    QLineEdit *m_path;
    QSpinBox *m_frames;
    QLabel *m_said;
    QString m_confirmed;                   ///< a path that was asked about when it was chosen
    std::optional<task::Reason> m_failure; ///< of the job that ends
    QPushButton *m_write = nullptr;
};

} // namespace pellucid::ui
