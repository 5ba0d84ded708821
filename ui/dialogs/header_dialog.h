// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QStringList>

#include "core/decoding/client/attribute.h"
#include "ui/jobs/job_runner.h"

class QLineEdit;
class QSlider;
class QSpinBox;
class QTreeWidget;

namespace pellucid::ui {

class PlainLabel;

/// The attributes of the files of a series, with a search for tags, names and values. Stays open
/// beside the picture.
class HeaderDialog : public QDialog {
    Q_OBJECT
public:
    /// *Shape*: `files`: at least one; `file`: the index of the first that is shown.
    HeaderDialog(const QStringList &files, int file, QWidget *parent);
    ~HeaderDialog() override;

    void showFile(int file);

private:
    void fill(const decoding::AttributeList &list);
    void search();
    void copySelected();

    QStringList m_files;
    JobRunner m_jobs;
    QSpinBox *m_number;
    QSlider *m_slider;
    QLineEdit *m_search;
    PlainLabel *m_name, *m_message;
    QTreeWidget *m_tree;
    QString m_warning; ///< about the file that is shown; empty if there is none
};

} // namespace pellucid::ui
