// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace pellucid::archive {

/// Random bytes from the system, as letters, digits, - and _ (base64url). *Throws* Error{internal}.
std::string randomText(std::size_t bytes);

/// The challenge that proves later that this program knows the verifier: its SHA-256 in base64url.
/// *Source*: RFC 7636, 4.2.
std::string codeChallenge(const std::string &verifier);

} // namespace pellucid::archive
