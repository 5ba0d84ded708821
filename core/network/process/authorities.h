// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::network::process {

/// The file with the certificates that the system trusts, in PEM format; empty if there is none
/// where distributions keep it. Not OpenSSL's own path, which is that of the machine it was built
/// on.
std::string systemAuthoritiesFile();

} // namespace pellucid::network::process
