// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/batch/memory_shares.h"

#include <algorithm>
#include <chrono>

namespace pellucid::batch {

MemoryShares::Share MemoryShares::take(std::size_t needed, const task::Progress &progress) {
    constexpr std::chrono::milliseconds pause(50); // after a cancel
    const std::size_t wanted =
        std::min(m_bytes, std::max(needed, m_bytes / std::size_t(std::max(1, m_jobs))));
    std::unique_lock lock(m_mutex);
    const char place = 0; // its address
    m_waiting.push_back(&place);
    while (m_waiting.front() != &place || m_free < wanted) {
        if (progress.stopRequested()) {
            std::erase(m_waiting, &place);
            m_changed.notify_all();
            progress.check();
        }
        m_changed.wait_for(lock, pause);
    }
    m_waiting.pop_front();
    m_changed.notify_all();
    m_free -= wanted;
    return {*this, wanted};
}

void MemoryShares::giveBack(std::size_t bytes) {
    {
        const std::lock_guard lock(m_mutex);
        m_free += bytes;
    }
    m_changed.notify_all();
}

} // namespace pellucid::batch
