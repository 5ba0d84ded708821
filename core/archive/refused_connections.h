// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "core/task/reason.h"

namespace pellucid::archive {

/// Decides which refused connections are reported, so that strangers cannot fill a log: the first
/// of each address and kind of reason, and once a minute the number of all others. Thread-safe.
class RefusedConnections {
public:
    using Clock = std::chrono::steady_clock;

    /// Whether this one is reported. If not, it is counted.
    bool isNew(const std::string &address, const task::Reason &reason,
               Clock::time_point now = Clock::now());
    /// At the end of each minute, the number of connections counted in it; otherwise nothing.
    std::optional<task::Reason> summary(Clock::time_point now = Clock::now());

private:
    struct Known {
        Clock::time_point last;
        std::set<std::string_view> reasons; // names
    };

    std::mutex m_mutex;
    std::map<std::string, Known> m_known; ///< addresses; a limited number
    std::size_t m_count = 0;              ///< since `m_begin`
    Clock::time_point m_begin;
    std::string m_address; ///< of all that were counted; empty: there are several
};

} // namespace pellucid::archive
