// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

class QPushButton;
class QVBoxLayout;

namespace pellucid::ui {

/// What is offered while nothing is open: files, a folder, the phantoms, recent studies.
class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(QWidget *parent = nullptr);

    /// What is opened again by a click: its name, and what `recentRequested` gives.
    struct Recent {
        QString text, entry;
    };
    void setRecent(const std::vector<Recent> &recent);
    /// What was open when the program ended is there to be taken up; `hasEnded`: as it should.
    void setOffersResuming(bool offers, bool hasEnded);

signals:
    void openFilesRequested();
    void openFolderRequested();
    void phantomRequested(const QString &kind);
    void recentRequested(const QString &entry);
    void resumeRequested();

private:
    QPushButton *m_resume;
    QVBoxLayout *m_recent;
};

} // namespace pellucid::ui
