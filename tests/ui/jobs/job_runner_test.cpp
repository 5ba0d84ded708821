// SPDX-License-Identifier: GPL-3.0-or-later
// `onEnd` reports the end of a job exactly once, however the job ends.
#include <atomic>
#include <memory>
#include <vector>

#include <QSignalSpy>
#include <QThread>
#include <QtTest>

#include "core/task/error.h"
#include "core/task/reasons.h"
#include "ui/jobs/job_runner.h"

namespace pellucid {

namespace because = task::because;
using ui::Job;
using ui::JobRunner;
using ui::Outcome;

using Kind = Outcome::Kind;

namespace {

// Runs until it is asked to stop.
void endless(const Job &job) {
    for (;;) {
        job.progress().check();
        QThread::yieldCurrentThread();
    }
}

} // namespace

class JobRunnerTest : public QObject {
    Q_OBJECT
private slots:
    void init() {
        m_runner = std::make_unique<JobRunner>();
        m_events.clear();
    }
    void cleanup() { m_runner.reset(); }

    void aJobIsDoneAfterAllItsDeliveries() {
        m_runner->start(
            "job",
            [this](const Job &job) { job.deliver([this] { m_events.emplace_back("delivered"); }); },
            recorder("job"));
        QVERIFY(m_runner->isRunning());
        QTRY_VERIFY(!m_runner->isRunning());
        QCOMPARE(m_events, QStringList({"delivered", "job done"}));
        expectNoMore();
    }

    void aFailureReportsReasonAndPath() {
        const QSignalSpy failed(m_runner.get(), &JobRunner::failed);
        std::vector<Outcome> outcomes;
        const auto listen = [&](const Outcome &outcome) { outcomes.push_back(outcome); };
        m_runner->start(
            "of a file",
            [](const Job &) {
                throw task::Error(task::ErrorCode::unusable, because::isEmpty, "/file");
            },
            listen, "/folder");
        QTRY_COMPARE(outcomes.size(), std::size_t(1));
        m_runner->start(
            "of no file", [](const Job &) { throw std::bad_alloc(); }, listen, "/folder");
        QTRY_COMPARE(outcomes.size(), std::size_t(2));
        QVERIFY(outcomes[0].kind == Kind::failed && outcomes[1].kind == Kind::failed);
        QVERIFY(outcomes[0].reason->is(because::isEmpty));
        QCOMPARE(outcomes[0].path, QString("/file"));
        QVERIFY(outcomes[1].reason->is(because::notEnoughMemory));
        QCOMPARE(outcomes[1].path, QString("/folder"));
        QCOMPARE(failed.size(), 2);
    }

    void aCancelledJobEndsAtOnceAndDeliversNoMore() {
        m_runner->start(
            "job",
            [this](const Job &job) {
                job.deliver([this] { m_events.emplace_back("delivered"); });
                endless(job);
            },
            recorder("job"));
        QTRY_COMPARE(m_events, QStringList({"delivered"}));
        m_runner->cancel();
        QVERIFY(!m_runner->isRunning());
        QCOMPARE(m_events, QStringList({"delivered", "job cancelled"}));
        m_runner->cancel();
        expectNoMore();
    }

    void workThatThrowsCancelledIsCancelled() {
        m_runner->start(
            "job", [](const Job &) { throw task::Cancelled(); }, recorder("job"));
        QTRY_COMPARE(m_events, QStringList({"job cancelled"}));
    }

    void aReplacedJobIsCancelledBeforeTheNextStarts() {
        connect(m_runner.get(), &JobRunner::started, this,
                [this](const QString &title) { m_events << title + " started"; });
        m_runner->start("one", endless, recorder("one"));
        m_runner->start(
            "two", [](const Job &) {}, recorder("two"));
        QTRY_VERIFY(!m_runner->isRunning());
        QCOMPARE(m_events,
                 QStringList({"one started", "one cancelled", "two started", "two done"}));
        expectNoMore();
    }

    // A job cannot slip in between the one that ends and the one that replaces it.
    void aJobThatStartsInBetweenIsCancelled() {
        m_runner->start("one", endless, [this](const Outcome &) {
            m_events << (m_runner->isRunning() ? "running" : "idle");
            m_runner->start("between", endless, recorder("between"));
        });
        m_runner->start(
            "two", [](const Job &) {}, recorder("two"));
        QCOMPARE(m_events, QStringList({"running", "between cancelled"}));
        QTRY_COMPARE(m_events, QStringList({"running", "between cancelled", "two done"}));
    }

    void onEndMayStartTheNextJob() {
        const QSignalSpy finished(m_runner.get(), &JobRunner::finished);
        m_runner->start(
            "one", [](const Job &) {},
            [&](const Outcome &) {
                m_events << (m_runner->isRunning() ? "running" : "idle");
                QCOMPARE(finished.size(), 1); // observers are notified first
                m_runner->start(
                    "two", [](const Job &) {}, recorder("two"));
            });
        QTRY_COMPARE(m_events, QStringList({"idle", "two done"}));
        QCOMPARE(finished.size(), 2);
    }

    void aJobThatIsCancelledAsItStartsDoesNotRun() {
        connect(m_runner.get(), &JobRunner::started, m_runner.get(), &JobRunner::cancel);
        std::atomic<bool> hasBegun = false;
        m_runner->start(
            "job", [&](const Job &) { hasBegun = true; }, recorder("job"));
        QCOMPARE(m_events, QStringList({"job cancelled"}));
        m_runner->join();
        QVERIFY(!hasBegun);
        expectNoMore();
    }

    void joiningEndsTheJobAndStartsNoOther() {
        m_runner->start("job", endless, [this](const Outcome &) {
            m_events << "ended";
            m_runner->start("next", endless, recorder("next"));
        });
        m_runner->join();
        QCOMPARE(m_events, QStringList({"ended", "next cancelled"}));
        QVERIFY(!m_runner->isRunning());
    }

    void destroyingTheRunnerEndsItsJob() {
        std::atomic<int> threads = 0;
        m_runner->start(
            "job",
            [&](const Job &job) {
                ++threads;
                try {
                    endless(job);
                } catch (const task::Cancelled &) {
                    --threads;
                    throw;
                }
            },
            recorder("job"));
        QTRY_COMPARE(threads.load(), 1);
        bool isShown = false;
        connect(m_runner.get(), &JobRunner::finished, this, [&] { isShown = true; });
        m_runner.reset();
        QCOMPARE(m_events, QStringList({"job cancelled"}));
        QCOMPARE(threads.load(), 0); // it was waited for
        QVERIFY(!isShown);
        expectNoMore();
    }

    void onEndIsCalledEvenIfASlotThrows() {
        connect(m_runner.get(), &JobRunner::finished, this, [] { throw std::bad_alloc(); });
        m_runner->start("job", endless, recorder("job"));
        QVERIFY_EXCEPTION_THROWN(m_runner->cancel(), std::bad_alloc);
        QCOMPARE(m_events, QStringList({"job cancelled"}));
        QVERIFY(!m_runner->isRunning());
    }

private:
    JobRunner::OnEnd recorder(const QString &name) {
        return [this, name](const Outcome &outcome) {
            QVERIFY(QThread::currentThread() == thread());
            m_events << name + (outcome.kind == Kind::done        ? " done"
                                : outcome.kind == Kind::cancelled ? " cancelled"
                                                                  : " failed");
        };
    }
    // No event is queued.
    void expectNoMore() {
        const QStringList heard = m_events;
        QCoreApplication::processEvents();
        QCOMPARE(m_events, heard);
    }

    std::unique_ptr<JobRunner> m_runner;
    QStringList m_events;
};

} // namespace pellucid

QTEST_GUILESS_MAIN(pellucid::JobRunnerTest)

#include "job_runner_test.moc"
