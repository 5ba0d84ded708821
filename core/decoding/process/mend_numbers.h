// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

class DcmItem;

namespace pellucid::decoding::process {

/// Rewrites decimal numbers that careless writers leave, so that others read them: "1,5" becomes
/// 1.5, "0.5,0.5" two values, and a number under a value representation of texts or bytes a decimal
/// string. Other texts are left. *Returns* bits of `decoding::Oddity`.
std::uint32_t mendNumbers(DcmItem &dataset);

} // namespace pellucid::decoding::process
