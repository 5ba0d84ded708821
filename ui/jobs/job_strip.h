// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace pellucid::ui {

class JobRunner;

/// What runs, how far it is, and the way to stop it; empty when nothing runs.
class JobStrip : public QWidget {
    Q_OBJECT
public:
    JobStrip(JobRunner &jobs, const QString &name, QWidget *parent = nullptr);

private:
    void showStarted(const QString &title);

    QProgressBar *m_progress;
    QLabel *m_title;
    QPushButton *m_cancel;
};

} // namespace pellucid::ui
