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

/// Passed to the work of a job: reports progress and delivers results to the user interface.
class Job {
public:
    const task::Progress &progress() const { return m_progress; }
    /// Runs a function on the user interface's thread, unless the job has ended by then.
    void deliver(std::function<void()> onUiThread) const;
    /// Sets the title that the status bar shows from now on.
    void stage(const QString &title) const;

private:
    friend class JobRunner;
    class JobRunner *m_runner = nullptr;
    quint64 m_generation = 0;
    task::Progress m_progress;
};

/// How a job ended. A cancelled job may have delivered all its results already.
struct Outcome {
    enum class Kind { done, failed, cancelled };
    Kind kind = Kind::done;
    /// Why the job failed, and the file or folder concerned, if any.
    std::optional<task::Reason> reason{};
    QString path{};
};

/// Runs one long piece of work at a time on a thread of its own. Cancelling, or starting another
/// job, returns at once: the old work is asked to stop, and whatever it still delivers is dropped,
/// because its generation is over.
///
/// `onEnd` reports the end of a job to the code that started it. The signals are for observers that
/// show what the runner does or wait until it is idle. A job that ends emits `failed` if it failed,
/// then `finished`, then calls `onEnd`; a job that replaces it emits `started` after that.
class JobRunner : public QObject {
    Q_OBJECT
public:
    using Work = std::function<void(const Job &)>;
    using OnEnd = std::function<void(const Outcome &)>;

    explicit JobRunner(QObject *parent = nullptr);
    /// Ends the job as cancelled, without signals, and waits for all threads.
    ~JobRunner() override;

    /// Starts work and replaces the running job, if there is one. `onEnd` is called exactly once,
    /// on the user interface's thread: when the work is done or has failed; as cancelled, if
    /// cancel(), join(), another start() or the runner's destructor comes first; before start()
    /// returns, if no thread is available. It may start the next job. While a job gives way to
    /// another start() or to join(), isRunning() is true and a third job is cancelled at once.
    /// `about`: the path to report with a failure that names none. *Requires*: everything that
    /// `work` and `onEnd` refer to outlives the job.
    void start(const QString &title, Work work, OnEnd onEnd = {}, const QString &about = {});
    void cancel();
    /// Cancels the job and waits until no work runs.
    void join();
    /// Also true while a job gives way to the next.
    bool isRunning() const { return m_isRunning || m_isMakingWay; }

signals:
    void started(const QString &title);
    void progressed(double fraction);
    /// The current job ended: done, failed or cancelled.
    void finished();
    /// The current job failed; `finished` follows.
    void failed(const pellucid::task::Reason &what, const QString &path);

private:
    friend class Job;
    // Not a QThreadPool, which QtConcurrent uses too: if the system has no thread left, the pool
    // drops the work without an error, and its destructor waits forever. std::jthread throws.
    struct Thread {
        std::shared_ptr<std::atomic<bool>> hasFinished;
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
    bool m_isMakingWay = false; ///< the former job is ending; no third job may take its place
    OnEnd m_onEnd;
    std::vector<Thread> m_threads;
};

} // namespace pellucid::ui
