// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace pellucid::batch {

/// A UID that depends on the text only, so that what is made twice is one object: 2.25 and a UUID
/// (PS3.5, B.2) of version 8 (RFC 9562), which has 122 bits of SHA-256. It does not reveal the
/// text.
std::string derivedUid(const std::string &of);

} // namespace pellucid::batch
