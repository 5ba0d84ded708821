// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "ui/picture_export.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace pellucid::ui {

/// Which pane, in which format and size, with or without annotations, and where to. What cannot be
/// written is said before, what could not be stays in the dialog.
class ExportDialog : public QDialog {
    Q_OBJECT
public:
    ExportDialog(const Document &document, const Panes &panes, QWidget *parent = nullptr);

private:
    PictureExport chosen() const;
    void showChosen();
    void browse();
    void write();

    const Document &m_document;
    Panes m_panes;
    QComboBox *m_pane, *m_format, *m_scale;
    QCheckBox *m_annotated;
    QLineEdit *m_path;
    QLabel *m_said;
    QPushButton *m_write = nullptr;
};

} // namespace pellucid::ui
