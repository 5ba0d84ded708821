// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace pellucid::task {

/// Threads for work that lasts less than a wake-up: the parts of one frame.
///
/// The caller works itself and waits only for parts that another thread has begun, so a worker
/// that wakes late costs nothing. Workers are pinned, one to a processor, because the scheduler
/// takes milliseconds to pull two threads off the same one; the worker of the processor that the
/// caller runs on is left asleep.
class WorkerTeam {
public:
    /// `threads`: how many may work at once, the caller included; 0: as many as oneTBB may use.
    /// Fewer where the system has no more threads to give.
    explicit WorkerTeam(int threads = 0);
    ~WorkerTeam();
    WorkerTeam(const WorkerTeam &) = delete;
    WorkerTeam &operator=(const WorkerTeam &) = delete;

    int threads() const { return m_threads; }
    /// Numbers that `run` gives its work are below this.
    int slots() const;

    /// A number of parts that may run in any order and on any thread.
    struct Phase {
        int parts = 0;
        /// *Shape*: part in 0..parts-1; slot: a number no other running part has, for scratch.
        void (*work)(void *context, int part, int slot) = nullptr;
        void *context = nullptr;
    };
    /// Runs the phases one after the other; a phase begins when the one before has ended. Not safe
    /// to call from two threads at once. The work must not throw.
    void run(std::span<const Phase> phases);

private:
    struct Worker;
    void work(Worker &worker);
    bool takePart(int slot);

    int m_threads;
    std::vector<std::unique_ptr<Worker>> m_workers;
    // Phase number, parts and the next part in one word: a thread that comes late cannot take a
    // part of a phase that is over.
    alignas(64) std::atomic<std::uint64_t> m_claim{0};
    alignas(64) std::atomic<int> m_done{0};
    Phase m_phase;
    std::atomic<bool> m_stop{false};
};

} // namespace pellucid::task
