// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

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

} // namespace pellucid::ui
