// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::parse {

/// Ends this process where a request takes longer than anybody waits, and where the program that
/// asked has ended meanwhile: one that is killed says nothing. One for a process.
class Watch {
public:
    Watch();
    /// For a request that begins. *Units*: seconds.
    void allow(double seconds);
    /// The same time again, for its next part.
    void resume();
    /// Whoever waits sees the other end go.
    void rest();

private:
    int m_seconds = 0;
};

} // namespace pellucid::parse
