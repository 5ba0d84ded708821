// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/task/progress.h"

#include <algorithm>

namespace pellucid::task {

Progress::Progress(std::stop_token stop, Report report)
    : m_stop(std::move(stop)), m_report(std::move(report)) {}

void Progress::check() const {
    if (m_stop.stop_requested())
        throw Cancelled{};
}

void Progress::report(double fraction) const {
    check();
    if (m_report)
        m_report(m_from + (m_to - m_from) * std::clamp(fraction, 0.0, 1.0));
}

Progress Progress::part(double from, double to) const {
    Progress sub = *this;
    sub.m_from = m_from + (m_to - m_from) * from;
    sub.m_to = m_from + (m_to - m_from) * to;
    return sub;
}

} // namespace pellucid::task
