// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/jobs/job_runner.h"

#include <chrono>
#include <new>

#include "ui/language/failure.h"

namespace pellucid::ui {

void Job::deliver(std::function<void()> onUiThread) const {
    m_runner->post(m_generation, std::move(onUiThread));
}

void Job::stage(const QString &title) const {
    deliver([runner = m_runner, title] { emit runner->started(title); });
}

JobRunner::JobRunner(QObject *parent) : QObject(parent) {}

JobRunner::~JobRunner() {
    ++m_generation;
    for (Thread &t : m_threads)
        t.thread.request_stop();
    m_threads.clear(); // joins
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

void JobRunner::start(const QString &title, Work work, const QString &about) {
    m_title = title;
    cancel();
    joinFinished();
    const quint64 generation = ++m_generation;
    m_running = true;
    emit started(title);
    try {
        launch(generation, std::move(work), about);
    } catch (const std::exception &) { // there is no thread for it
        m_running = false;
        emit failed(task::because::notEnoughMemory, about);
        emit finished();
    }
}

void JobRunner::launch(quint64 generation, Work work, const QString &about) {
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
             } catch (const task::Cancelled &) {
             } catch (...) {
                 failure = std::current_exception();
             }
             finish(generation, failure, about, stop);
             over->store(true);
         })});
}

// Whatever comes of saying it: who waits for the end is told.
void JobRunner::say(const std::exception_ptr &failure, const QString &about) {
    if (!failure)
        return;
    try {
        const Failure said = [&] {
            try {
                std::rethrow_exception(failure);
            } catch (...) {
                return currentFailure();
            }
        }();
        emit failed(said.what, said.path.isEmpty() ? about : said.path);
    } catch (const std::exception &) { // there is no memory for the words either
    }
}

// The last word of the thread that worked. Work that failed for want of memory may have left none
// for it; others give some back.
void JobRunner::finish(quint64 generation, const std::exception_ptr &failure, const QString &about,
                       const std::stop_token &stop) noexcept {
    while (!stop.stop_requested()) {
        try {
            post(generation, [this, failure, about] {
                m_running = false;
                say(failure, about);
                emit finished();
            });
            return;
        } catch (const std::bad_alloc &) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
}

void JobRunner::join() {
    cancel();
    m_threads.clear();
}

void JobRunner::cancel() {
    for (Thread &t : m_threads)
        t.thread.request_stop();
    if (!m_running)
        return;
    ++m_generation;
    m_running = false;
    emit finished();
}

} // namespace pellucid::ui
