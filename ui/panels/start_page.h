// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

class QPushButton;
class QVBoxLayout;

namespace pellucid::ui {

/// Shown while no study is open: offers files, a folder, the phantoms and recent studies.
class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(QWidget *parent = nullptr);

    /// A recent study: its text, and the argument of `recentRequested`.
    struct Recent {
        QString text, entry;
    };
    void setRecent(const std::vector<Recent> &recent);
    /// Offers to reopen the last session. `hasEnded`: it ended normally.
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
