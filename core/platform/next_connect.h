// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pellucid::platform {

// Programs that link this have a `connect` of their own, in place of the system's: a socket that
// is connected stays so, where the system's would fail or, in a confined process, be forbidden.
// libcurl 7.88 connects even a socket that it is told is connected.

/// The next socket that a library of this process connects is left as it is, and the library told
/// that it is connected.
void skipNextConnect();

} // namespace pellucid::platform
