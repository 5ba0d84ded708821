// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QVBoxLayout;

namespace pellucid::ui {

/// What is offered while nothing is open: files, a folder, the phantoms, recent studies.
class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(QWidget *parent = nullptr);

    void setRecentPaths(const QStringList &paths);

signals:
    void openFilesRequested();
    void openFolderRequested();
    void phantomRequested(const QString &kind);
    void pathRequested(const QString &path);

private:
    QVBoxLayout *m_recent;
};

} // namespace pellucid::ui
