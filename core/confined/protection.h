// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace pellucid::confined {

/// Takes the protections that a helper has reported, as bits of platform::Confinement: logs them
/// once for each kind of helper, and calls the handler of `whenUnprotected`. *Throws* what that
/// throws.
void noteProtection(const std::string &helpers, int bits);

/// Sets what happens when a helper reports that its system calls are not filtered: a file or a
/// server that takes it over then reaches what the user can reach. `handler` is called for each
/// such helper, from any thread, one call at a time; if it throws, the helper is not used. Set it
/// before the first helper starts.
void whenUnprotected(std::function<void()> handler);

} // namespace pellucid::confined
