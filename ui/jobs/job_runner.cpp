// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/jobs/job_runner.h"

#include <chrono>
#include <new>
#include <utility>

#include <QScopedValueRollback>

#include "core/task/reasons.h"
#include "ui/language/failure.h"

namespace pellucid::ui {

namespace {

Outcome outcomeOf(const std::exception_ptr &failure, const QString &about) {
    if (!failure)
        return {};
    try {
        std::rethrow_exception(failure);
    } catch (const task::Cancelled &) {
        return {Outcome::Kind::cancelled};
    } catch (...) {
        try {
            const Failure known = currentFailure();
            return {Outcome::Kind::failed, known.what, known.path.isEmpty() ? about : known.path};
        } catch (const std::exception &) { // no memory for the text of the failure
            return {Outcome::Kind::failed, task::because::notEnoughMemory, about};
        }
    }
}

} // namespace

void Job::deliver(std::function<void()> onUiThread) const {
    m_runner->post(m_generation, std::move(onUiThread));
}

void Job::stage(const QString &title) const {
    deliver([runner = m_runner, title] { emit runner->started(title); });
}

JobRunner::JobRunner(QObject *parent) : QObject(parent) {}

JobRunner::~JobRunner() {
    blockSignals(true); // observers may be half destroyed
    try {
        join();
    } catch (...) { // `onEnd` may run out of memory
        m_threads.clear();
    }
}

void JobRunner::post(quint64 generation, std::function<void()> onUiThread) {
    // Queued to this object: the call is dropped if the object is destroyed first.
    QMetaObject::invokeMethod(
        this,
        [this, generation, run = std::move(onUiThread)] {
            if (generation == m_generation)
                run();
        },
        Qt::QueuedConnection);
}

void JobRunner::joinFinished() {
    std::erase_if(m_threads, [](const Thread &t) { return t.hasFinished->load(); });
}

void JobRunner::start(const QString &title, Work work, OnEnd onEnd, const QString &about) {
    if (m_isMakingWay) {
        if (onEnd)
            onEnd({Outcome::Kind::cancelled});
        return;
    }
    try {
        makeWay();
    } catch (...) { // a slot or the former job's `onEnd` threw
        if (onEnd)
            onEnd({Outcome::Kind::failed, task::because::notEnoughMemory, about});
        throw;
    }
    joinFinished();
    const quint64 generation = ++m_generation;
    m_onEnd = std::move(onEnd);
    m_isRunning = true;
    try {
        emit started(title);
        if (generation == m_generation) // no slot cancelled it
            launch(generation, std::move(work), about);
    } catch (const std::exception &) { // no thread is available
        if (generation == m_generation)
            end({Outcome::Kind::failed, task::because::notEnoughMemory, about});
    }
}

void JobRunner::launch(quint64 generation, Work work, const QString &about) {
    m_threads.reserve(m_threads.size() + 1); // before the thread runs: this may throw
    auto hasFinished = std::make_shared<std::atomic<bool>>(false);
    m_threads.push_back(
        {hasFinished, std::jthread([this, generation, hasFinished, about,
                                    work = std::move(work)](const std::stop_token &stop) {
             std::exception_ptr failure;
             try {
                 Job job;
                 job.m_runner = this;
                 job.m_generation = generation;
                 // A report for each file would flood the queue; thirty a second look smooth.
                 auto last = std::make_shared<std::atomic<std::chrono::steady_clock::rep>>(0);
                 job.m_progress = task::Progress(stop, [this, generation, last](double fraction) {
                     const auto now = std::chrono::steady_clock::now().time_since_epoch();
                     auto before = last->load();
                     if (now - std::chrono::steady_clock::duration(before) <
                             std::chrono::milliseconds(33) ||
                         !last->compare_exchange_strong(before, now.count()))
                         return;
                     post(generation, [this, fraction] { emit progressed(fraction); });
                 });
                 work(job);
             } catch (...) {
                 failure = std::current_exception();
             }
             postEnd(generation, failure, about, stop);
             hasFinished->store(true);
         })});
}

// Runs last on the job's thread. If memory is exhausted, it retries until other threads free some.
void JobRunner::postEnd(quint64 generation, const std::exception_ptr &failure, const QString &about,
                        const std::stop_token &stop) noexcept {
    while (!stop.stop_requested()) {
        try {
            post(generation, [this, failure, about] { end(outcomeOf(failure, about)); });
            return;
        } catch (const std::bad_alloc &) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
}

// Calls `onEnd` even if a slot throws.
void JobRunner::end(const Outcome &outcome) {
    ++m_generation; // drops what the job still delivers
    m_isRunning = false;
    const OnEnd onEnd = std::exchange(m_onEnd, nullptr);
    const auto notifyStarter = [&] {
        if (onEnd)
            onEnd(outcome);
    };
    try {
        if (outcome.kind == Outcome::Kind::failed)
            emit failed(*outcome.reason, outcome.path);
    } catch (const std::exception &) { // no memory to show the failure either
    }
    try {
        emit finished();
    } catch (...) {
        notifyStarter();
        throw;
    }
    notifyStarter();
}

void JobRunner::makeWay() {
    const QScopedValueRollback making(m_isMakingWay, true);
    cancel();
}

void JobRunner::join() {
    makeWay();
    m_threads.clear();
}

void JobRunner::cancel() {
    for (Thread &t : m_threads)
        t.thread.request_stop();
    if (m_isRunning)
        end({Outcome::Kind::cancelled});
}

} // namespace pellucid::ui
