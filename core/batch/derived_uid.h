// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::batch {

/// A UID that depends on the text only (PS3.5, B.2: 2.25 and a number of 128 bits), so that what is
/// made twice is one object. It does not reveal the text: SHA-256.
std::string derivedUid(const std::string &of);

} // namespace pellucid::batch
