// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QStringList>

#include "ui/library/import_studies.h"

class QListWidget;
class QPushButton;
class QRadioButton;

namespace pellucid::ui {

class PlainLabel;

/// Selects what to import, and whether by reference or by copy; remembers that choice.
class ImportDialog : public QDialog {
    Q_OBJECT
public:
    explicit ImportDialog(const QStringList &paths, QWidget *parent = nullptr);

signals:
    void chosen(const pellucid::ui::Import &import);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void add(const QStringList &paths);
    void removeSelected();
    void showPaths();
    void accept() override;

    QStringList m_paths;
    PlainLabel *m_hint;
    QListWidget *m_list;
    QPushButton *m_remove;
    QRadioButton *m_refer, *m_copy;
    QPushButton *m_import;
};

} // namespace pellucid::ui
