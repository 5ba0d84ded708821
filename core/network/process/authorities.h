// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::network::process {

/// The text of a file in PEM format. *Throws* Error{usage} if it cannot be opened.
std::string pemText(const std::string &path);
/// The certificates of the authorities in a file, or of those that the system trusts if the path is
/// empty, in PEM format. *Throws* Error{usage}.
std::string authorityCertificates(const std::string &path);

} // namespace pellucid::network::process
