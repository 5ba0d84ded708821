// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
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

/// How a job ended. A cancelled job may have delivered all its results before.
struct Outcome {
    enum class Kind { done, failed, cancelled };
    Kind kind = Kind::done;
    /// Why a job failed, and the file or folder concerned, if any.
    std::optional<task::Reason> reason{};
    QString path{};
};

/// Runs one long piece of work at a time on a thread of its own. Starting another, or cancelling,
/// gives the program back at once: the old work is asked to stop, and whatever it still delivers is
/// dropped, because its generation is over.
///
/// The starter of a job learns its end by `onEnd`. Signals are for observers that show what the
/// runner does or wait until it is idle. At the end of a job come `failed`, `finished` and `onEnd`,
/// in this order; `started` of a job that replaces it comes after them.
class JobRunner : public QObject {
    Q_OBJECT
public:
    using Work = std::function<void(const Job &)>;
    using OnEnd = std::function<void(const Outcome &)>;

    explicit JobRunner(QObject *parent = nullptr);
    /// Ends the job as cancelled, without signals, and waits for its thread.
    ~JobRunner() override;

    /// Starts work, in place of the running job if there is one. `onEnd` is called exactly once, on
    /// the user interface's thread: when the work is done or has failed; as cancelled, if cancel(),
    /// join(), another start() or the runner's destructor comes first; before start() returns, if
    /// no thread can be had. It may start the next job. While a job gives way to another start() or
    /// to join(), isRunning() is true and a third job is cancelled at once. `about`: the path of
    /// failures that name none. *Requires*: whatever `work` and `onEnd` refer to outlives the job.
    void start(const QString &title, Work work, OnEnd onEnd = {}, const QString &about = {});
    void cancel();
    /// Cancels and waits until no work runs any more.
    void join();
    /// True also while a job gives way to the next.
    bool isRunning() const { return m_isRunning || m_isMakingWay; }
    /// Of the current job, or of the last one.
    const QString &title() const { return m_title; }

signals:
    void started(const QString &title);
    void progressed(double fraction);
    /// The current job is over: done, failed or cancelled.
    void finished();
    /// The current job failed; `finished` follows.
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    friend class Job;
    struct Thread {
        std::shared_ptr<std::atomic<bool>> over;
        std::jthread thread;
    };
    void post(quint64 generation, std::function<void()> onUiThread);
    void launch(quint64 generation, Work work, const QString &about);
    void postEnd(quint64 generation, const std::exception_ptr &failure, const QString &about,
                 const std::stop_token &stop) noexcept;
    void end(const Outcome &outcome);
    void makeWay();
    void joinFinished();

    quint64 m_generation = 0;
    bool m_isRunning = false;
    bool m_isMakingWay = false; ///< the former job ends; no third job may take its place
    QString m_title;
    OnEnd m_onEnd;
    std::vector<Thread> m_threads;
};

} // namespace pellucid::ui
