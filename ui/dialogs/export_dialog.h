// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include <QDialog>

#include "core/archive/server.h"
#include "core/dicom/catalogue.h"
#include "core/task/reason.h"
#include "ui/export/picture_export.h"

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace pellucid::ui {

class Job;
class JobRunner;
class PlainLabel;
class ServerBook;

/// Exports a picture: asks for pane, format, size, annotations, and a file or a server. The dialog
/// shows why an export is impossible, or why it failed. Writing is a job: the dialog closes when it
/// is done; closing it earlier cancels the job.
class ExportDialog : public QDialog {
    Q_OBJECT
public:
    ExportDialog(const Document &document, const Panes &panes, JobRunner &jobs, ServerBook &servers,
                 QWidget *parent = nullptr);
    ~ExportDialog() override;

signals:
    void written(const QString &path);
    /// The server has confirmed the picture.
    void sent(const QString &server);
    /// A capture of the open study was written, which the list of studies shows.
    void captured(const std::shared_ptr<const pellucid::dicom::Catalogue> &capture);

private:
    PictureExport chosen() const;
    void offerPatient();
    void chooseCapture();
    void showChosen();
    void browse();
    void saveRecipe();
    void write();
    /// Asks before a file is replaced.
    void writeTo(const QString &path);
    void replace(const QString &path);
    void send(const archive::Server &server, const PictureExport &what);
    /// The server that the picture is sent to; empty: it is written to a file.
    QString chosenServer() const;
    void offerServers();
    void start(const QString &title, const std::function<void(const Job &)> &work);
    QFormLayout *form() const;
    void showMessage(const QString &text, const char *role);

    const Document &m_document;
    Panes m_panes;
    JobRunner &m_jobs;
    ServerBook &m_servers;
    QComboBox *m_to;
    QComboBox *m_pane, *m_format, *m_scale;
    QCheckBox *m_annotated;
    QComboBox *m_patient;
    int m_patientOf = -2; ///< the source that the names are of
    QCheckBox *m_deidentified;
    QLineEdit *m_path;
    QWidget *m_where; ///< the path with its button
    QSpinBox *m_frames;
    PlainLabel *m_message;
    bool m_isWorking = false;
    QString m_confirmed; ///< a path that the file dialog has asked about
    QString m_sentTo;    ///< the server that has just received it
    QPushButton *m_write = nullptr, *m_close = nullptr, *m_recipe = nullptr;
};

} // namespace pellucid::ui
