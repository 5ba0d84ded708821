// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>

namespace pellucid::task {

/// Thrown by a long function after its Progress was asked to stop.
struct Cancelled {};

/// A long function reports to it, and asks whether to continue.
///
/// A default-constructed Progress reports to nobody and never stops. Copies share the stop token;
/// `part` maps a subtask to a range of the caller's scale.
class Progress {
public:
    using Report = std::function<void(double fraction)>;

    Progress() = default;
    explicit Progress(std::stop_token stop, Report report = {});

    /// Reports a fraction in 0..1 of this task or part of a task. Throws Cancelled if asked to
    /// stop.
    void report(double fraction) const;
    /// Throws Cancelled if asked to stop.
    void check() const;
    bool stopRequested() const { return m_stop.stop_requested(); }
    const std::stop_token &stopToken() const { return m_stop; }
    /// The same task, with fractions mapped to [from, to] of this one.
    Progress part(double from, double to) const;

private:
    std::stop_token m_stop;
    Report m_report;
    double m_from = 0.0;
    double m_to = 1.0;
};

} // namespace pellucid::task
