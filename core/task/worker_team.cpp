// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/worker_team.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <system_error>
#include <thread>

#include <tbb/global_control.h>

#include "core/platform/threads.h"

namespace pellucid::task {

namespace {

constexpr int partBits = 20;
constexpr std::uint64_t partMask = (std::uint64_t(1) << partBits) - 1;

std::uint64_t claimWord(std::uint64_t phase, int parts) {
    return phase << (2 * partBits) | std::uint64_t(parts) << partBits;
}

// How long a worker looks for more work before it sleeps: longer than the gap between the phases of
// a frame, but negligible between frames.
constexpr auto patience = std::chrono::microseconds(60);

} // namespace

struct WorkerTeam::Worker {
    int slot = 0;
    int processor = -1; ///< -1: not pinned
    alignas(64) std::atomic<std::uint32_t> wake{0};
    std::atomic<bool> asleep{false};
    std::thread thread;
};

WorkerTeam::WorkerTeam(int threads) : m_threads(threads) {
    const auto allowed =
        int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    if (m_threads <= 0)
        m_threads = allowed;
    m_threads = std::clamp(m_threads, 1, 256);
    if (m_threads == 1)
        return;
    // One more worker than can work at once: the one that stays asleep depends on the processor
    // that the caller runs on.
    const std::vector<int> processors = platform::allowedProcessors();
    m_workers.reserve(std::size_t(m_threads)); // push_back must not throw: the thread runs already
    for (int n = 0; n < m_threads; ++n) {
        auto worker = std::make_unique<Worker>();
        worker->slot = n + 1;
        worker->processor =
            processors.empty() ? -1 : processors[std::size_t(n) % processors.size()];
        try {
            worker->thread = std::thread([this, w = worker.get()] { work(*w); });
        } catch (const std::system_error &) {
            break; // the team works with those that have started
        }
        m_workers.push_back(std::move(worker));
    }
}

WorkerTeam::~WorkerTeam() {
    m_stop = true;
    for (const auto &worker : m_workers) {
        worker->wake.fetch_add(1);
        platform::wakeOne(worker->wake);
    }
    for (const auto &worker : m_workers)
        worker->thread.join();
}

int WorkerTeam::slots() const {
    return int(m_workers.size()) + 1;
}

bool WorkerTeam::takePart(int slot) {
    std::uint64_t claim = m_claim.load(std::memory_order_acquire);
    for (;;) {
        const std::uint64_t next = claim & partMask, parts = (claim >> partBits) & partMask;
        if (next >= parts)
            return false;
        if (m_claim.compare_exchange_weak(claim, claim + 1, std::memory_order_acq_rel))
            break;
    }
    // The phase cannot end, and m_phase cannot change, before this part is counted as done.
    m_phase.work(m_phase.context, int(claim & partMask), slot);
    m_done.fetch_add(1, std::memory_order_release);
    return true;
}

void WorkerTeam::work(Worker &worker) {
    if (worker.processor >= 0)
        platform::stayOn(worker.processor);
    auto lastWork = std::chrono::steady_clock::now();
    while (!m_stop.load(std::memory_order_relaxed)) {
        const std::uint32_t seen = worker.wake.load(std::memory_order_acquire);
        if (takePart(worker.slot)) {
            while (takePart(worker.slot))
                ;
            lastWork = std::chrono::steady_clock::now();
            continue;
        }
        if (std::chrono::steady_clock::now() - lastWork < patience) {
            for (int n = 0; n < 16; ++n)
                platform::rest();
            continue;
        }
        worker.asleep.store(true);
        if (!m_stop.load())
            platform::sleepWhile(worker.wake, seen);
        worker.asleep.store(false);
        lastWork = std::chrono::steady_clock::now();
    }
}

void WorkerTeam::run(std::span<const Phase> phases) {
    std::uint64_t phaseNumber = m_claim.load(std::memory_order_relaxed) >> (2 * partBits);
    bool woken = m_workers.empty();
    for (const Phase &phase : phases) {
        assert(phase.parts >= 0 && std::uint64_t(phase.parts) < partMask);
        m_phase = phase;
        m_done.store(0, std::memory_order_relaxed);
        m_claim.store(claimWord(++phaseNumber, phase.parts), std::memory_order_seq_cst);
        if (!woken && phase.parts > 1) {
            woken = true;
            const int here = platform::currentProcessor();
            // The worker on the caller's processor stays asleep; if there is none, the last one.
            int skip = int(m_workers.size()) - 1;
            for (int n = 0; n < int(m_workers.size()); ++n)
                if (m_workers[n]->processor == here)
                    skip = n;
            for (int n = 0; n < int(m_workers.size()); ++n) {
                Worker &worker = *m_workers[n];
                if (n == skip || n >= m_threads)
                    continue;
                worker.wake.fetch_add(1);
                if (worker.asleep.load())
                    platform::wakeOne(worker.wake);
            }
        }
        while (takePart(0))
            ;
        while (m_done.load(std::memory_order_acquire) < phase.parts)
            platform::rest();
    }
}

} // namespace pellucid::task
