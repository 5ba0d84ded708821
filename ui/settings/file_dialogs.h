// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace pellucid::ui {

// Files and folders, asked for by Qt's dialogs. These write down where they have been, for all
// programs of Qt: here they do not, as folders may name patients. Empty: nothing was chosen.

QStringList askForFiles(QWidget *parent, const QString &title);
QString askForFile(QWidget *parent, const QString &title, const QString &filter);
QString askForFolder(QWidget *parent, const QString &title);
/// Asks before what is there is replaced.
QString askWhereToWrite(QWidget *parent, const QString &title, const QString &path,
                        const QString &filter);

} // namespace pellucid::ui
