// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <QWidget>

class QProgressBar;
class QPushButton;

namespace pellucid::ui {

class JobRunner;
class PlainLabel;

/// Shows the title and the progress of the running job, and a button that cancels it. Hidden while
/// no job runs.
class JobStrip : public QWidget {
    Q_OBJECT
public:
    /// `cancel`: what the button does; by default, it cancels the job.
    JobStrip(JobRunner &jobs, const QString &name, std::function<void()> cancel = {},
             QWidget *parent = nullptr);

private:
    void showStarted(const QString &title);

    QProgressBar *m_progress;
    PlainLabel *m_title;
    QPushButton *m_cancel;
};

} // namespace pellucid::ui
