// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::platform {

/// The certificates of the authorities that the system trusts, in PEM format; empty if it has none
/// where they are looked for.
std::string systemAuthorities();

} // namespace pellucid::platform
