// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include <QObject>

#include "core/task/error.h"
#include "core/task/progress.h"

namespace pellucid::ui {

/// What a job's work sees: its progress, and the way to hand results to the user interface.
class Job {
public:
    const task::Progress &progress() const { return m_progress; }
    /// Runs a function on the user interface's thread, unless the job is no longer the current one.
    void deliver(std::function<void()> onUiThread) const;
    /// Names the stage that the status bar shows.
    void stage(const QString &title) const;

private:
    friend class JobRunner;
    class JobRunner *m_runner = nullptr;
    quint64 m_generation = 0;
    task::Progress m_progress;
};

/// Runs one long piece of work at a time on a thread of its own. Starting another, or cancelling,
/// gives the program back at once: the old work is asked to stop, and whatever it still delivers is
/// dropped, because its generation is over.
class JobRunner : public QObject {
    Q_OBJECT
public:
    using Work = std::function<void(const Job &)>;

    explicit JobRunner(QObject *parent = nullptr);
    ~JobRunner() override;

    /// `about`: what failures are about that name no file.
    void start(const QString &title, Work work, const QString &about = {});
    void cancel();
    /// Cancels and waits until no work runs any more.
    void join();
    bool isRunning() const { return m_running; }
    /// Of the current job, or of the last one.
    const QString &title() const { return m_title; }

signals:
    void started(const QString &title);
    void progressed(double fraction);
    /// The current job is over: done, failed or cancelled.
    void finished();
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    friend class Job;
    struct Thread {
        std::shared_ptr<std::atomic<bool>> over;
        std::jthread thread;
    };
    void post(quint64 generation, std::function<void()> onUiThread);
    void launch(quint64 generation, Work work, const QString &about);
    void finish(quint64 generation, const std::exception_ptr &failure, const QString &about,
                const std::stop_token &stop) noexcept;
    void say(const std::exception_ptr &failure, const QString &about);
    void joinFinished();

    quint64 m_generation = 0;
    bool m_running = false;
    QString m_title;
    std::vector<Thread> m_threads;
};

} // namespace pellucid::ui
