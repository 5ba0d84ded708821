// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QPushButton;
class QVBoxLayout;

namespace pellucid::ui {

/// What is offered while nothing is open: files, a folder, the phantoms, recent studies.
class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(QWidget *parent = nullptr);

    void setRecentPaths(const QStringList &paths);
    /// What was open when the program ended is there to be taken up.
    void setOffersResuming(bool offers);

signals:
    void openFilesRequested();
    void openFolderRequested();
    void phantomRequested(const QString &kind);
    void pathRequested(const QString &path);
    void resumeRequested();

private:
    QPushButton *m_resume;
    QVBoxLayout *m_recent;
};

} // namespace pellucid::ui
