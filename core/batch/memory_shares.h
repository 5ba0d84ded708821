// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>

#include "core/task/progress.h"

namespace pellucid::batch {

/// Shares memory out among jobs that run at the same time.
class MemoryShares {
public:
    MemoryShares(std::size_t bytes, int jobs) : m_free(bytes), m_bytes(bytes), m_jobs(jobs) {}

    std::size_t bytes() const { return m_bytes; }
    int jobs() const { return m_jobs; }

    /// A part of the memory, given back with the object.
    class Share {
    public:
        Share(MemoryShares &of, std::size_t bytes) : m_of(of), m_bytes(bytes) {}
        ~Share() { m_of.giveBack(m_bytes); }
        Share(const Share &) = delete;
        Share &operator=(const Share &) = delete;
        std::size_t bytes() const { return m_bytes; }

    private:
        MemoryShares &m_of;
        std::size_t m_bytes;
    };
    /// An equal share, or more for a job that needs more, which waits for others to end; at most
    /// all. Jobs are served in the order in which they ask. *Throws* Cancelled.
    Share take(std::size_t needed, const task::Progress &progress);

private:
    void giveBack(std::size_t bytes);

    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::deque<const void *> m_waiting; ///< the next one first
    std::size_t m_free, m_bytes;
    int m_jobs;
};

} // namespace pellucid::batch
