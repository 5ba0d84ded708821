// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <utility>

namespace pellucid::cli {

/// Encodes and writes pictures on threads of their own while the next ones are rendered. The
/// destructor waits for them.
class WriteBehind {
public:
    /// Waits if too many are being written. *Throws* what one of them has thrown.
    void add(std::function<void()> write) {
        while (!m_pending.empty() && (m_pending.size() == most || isReady(m_pending.front())))
            waitForFirst();
        m_pending.push_back(std::async(std::launch::async, std::move(write)));
    }
    /// Waits until all are written. *Throws* as above.
    void finish() {
        while (!m_pending.empty())
            waitForFirst();
    }

private:
    void waitForFirst() {
        std::future<void> first = std::move(m_pending.front());
        m_pending.pop_front();
        first.get();
    }

    static bool isReady(const std::future<void> &written) {
        return written.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }

    static constexpr std::size_t most = 4; // each keeps a picture
    std::deque<std::future<void>> m_pending;
};

} // namespace pellucid::cli
