// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::test {

/// How long a test waits for a condition that must come true.
#ifdef PELLUCID_SANITIZED
inline constexpr int patienceMs = 240000;
#else
inline constexpr int patienceMs = 60000;
#endif

} // namespace pellucid::test
