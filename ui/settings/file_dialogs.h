// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

class QFormLayout;
class QLineEdit;
class QMimeData;
class QWidget;

namespace pellucid::ui {

// Qt's file dialogs, without the history of folders that they store for all Qt programs: folders
// may name patients. The result is empty if the user cancels.

QStringList askForFiles(QWidget *parent, const QString &title);
QString askForFile(QWidget *parent, const QString &title, const QString &filter);
QString askForFolder(QWidget *parent, const QString &title);
/// Asks before replacing an existing file.
QString askForSavePath(QWidget *parent, const QString &title, const QString &path,
                       const QString &filter);

/// The files and folders of this computer that are dragged.
QStringList localPaths(const QMimeData &data);

/// Adds a row for the path of a file, which can be typed or chosen.
QLineEdit *addFileRow(QFormLayout &form, const QString &label, const char *name,
                      const QString &tip);

} // namespace pellucid::ui
