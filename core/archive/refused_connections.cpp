// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/archive/refused_connections.h"

#include <utility>

#include "core/archive/reasons.h"

namespace pellucid::archive {

namespace {

namespace because = task::because;

constexpr std::size_t maxKnown = 64;
constexpr std::chrono::minutes summaryInterval(1), memory(60);

} // namespace

bool RefusedConnections::isNew(const std::string &address, const task::Reason &reason,
                               Clock::time_point now) {
    const std::lock_guard lock(m_mutex);
    std::erase_if(m_known, [&](const auto &one) { return now - one.second.last > memory; });
    // A reason may contain the AE title that the sender invents; its kind does not.
    if (m_known.contains(address) || m_known.size() < maxKnown) {
        Known &known = m_known[address];
        known.last = now;
        if (known.reasons.insert(reason.sentence().name).second)
            return true;
    }
    if (m_count == 0) {
        m_begin = now;
        m_address = address;
    } else if (m_address != address) {
        m_address.clear();
    }
    ++m_count;
    return false;
}

std::optional<task::Reason> RefusedConnections::summary(Clock::time_point now) {
    const std::lock_guard lock(m_mutex);
    if (m_count == 0 || now - m_begin < summaryInterval)
        return std::nullopt;
    const std::size_t count = std::exchange(m_count, 0);
    if (m_address.empty())
        return because::moreConnectionsRefused(count);
    return because::moreConnectionsRefusedFrom(m_address, count);
}

} // namespace pellucid::archive
