// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/jobs/job_runner.h"

#include <chrono>
#include <new>
#include <utility>

#include <QScopedValueRollback>

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
        } catch (const std::exception &) { // there is no memory for the words
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
    } catch (...) { // whoever learns of the end may find no memory
        m_threads.clear();
    }
}

void JobRunner::post(quint64 generation, std::function<void()> onUiThread) {
    // Queued to this object: if it is gone before, so is the call.
    QMetaObject::invokeMethod(
        this,
        [this, generation, run = std::move(onUiThread)] {
            if (generation == m_generation)
                run();
        },
        Qt::QueuedConnection);
}

void JobRunner::joinFinished() {
    std::erase_if(m_threads, [](const Thread &t) { return t.over->load(); });
}

void JobRunner::start(const QString &title, Work work, OnEnd onEnd, const QString &about) {
    if (m_isMakingWay) {
        if (onEnd)
            onEnd({Outcome::Kind::cancelled});
        return;
    }
    try {
        makeWay();
    } catch (...) { // the end of the former job could not be dealt with
        if (onEnd)
            onEnd({Outcome::Kind::failed, task::because::notEnoughMemory, about});
        throw;
    }
    joinFinished();
    const quint64 generation = ++m_generation;
    m_title = title;
    m_onEnd = std::move(onEnd);
    m_isRunning = true;
    try {
        emit started(title);
        if (generation == m_generation) // no slot cancelled it
            launch(generation, std::move(work), about);
    } catch (const std::exception &) { // no thread can be had
        if (generation == m_generation)
            end({Outcome::Kind::failed, task::because::notEnoughMemory, about});
    }
}

void JobRunner::launch(quint64 generation, Work work, const QString &about) {
    m_threads.reserve(m_threads.size() + 1); // before the thread runs: this may throw
    auto over = std::make_shared<std::atomic<bool>>(false);
    m_threads.push_back(
        {over, std::jthread([this, generation, over, about,
                             work = std::move(work)](const std::stop_token &stop) {
             std::exception_ptr failure;
             try {
                 Job job;
                 job.m_runner = this;
                 job.m_generation = generation;
                 // A report per file would flood the queue; thirty a second look smooth.
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
             over->store(true);
         })});
}

// The last word of the thread that worked. Work that failed for want of memory may have left none
// for it; others give some back.
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

// A slot that throws does not keep the starter from learning of the end.
void JobRunner::end(const Outcome &outcome) {
    ++m_generation; // what it still delivers is dropped
    m_isRunning = false;
    const OnEnd onEnd = std::exchange(m_onEnd, nullptr);
    const auto tellStarter = [&] {
        if (onEnd)
            onEnd(outcome);
    };
    try {
        if (outcome.kind == Outcome::Kind::failed)
            emit failed(*outcome.reason, outcome.path);
    } catch (const std::exception &) { // there is no memory for the words either
    }
    try {
        emit finished();
    } catch (...) {
        tellStarter();
        throw;
    }
    tellStarter();
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
