// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::platform {

/// Ends this helper if a request takes longer than the program waits, or if the program has ended:
/// a program that is killed cannot tell. One per process.
class Watch {
public:
    Watch();
    /// Starts the time limit of a request, of the processor's time: a slow disc does not count.
    /// *Units*: seconds.
    void allow(double seconds);
    /// Starts the same limit again for the next part of a request.
    void resume();
    /// No limit while waiting for the other side.
    void pause();

private:
    int m_seconds = 0;
};

} // namespace pellucid::platform
