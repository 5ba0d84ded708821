// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/error/stated_error.h"

namespace pellucid::bench {

/// A picture of a sweep, and its errors. *Units*: relative L2.
struct SweptPicture {
    std::string name; ///< kind of field, size, view and tolerance
    double tolerance = 0.0;
    double planned = 0.0; ///< the plan's bound for every view; above the tolerance if none meets it
    error::StatedError stated; ///< of this picture, measured as the program does
    double measured = 0.0;     ///< against the exact picture
};

/// Pictures of random fields, one kind after the other, each at five tolerances from 1e-2 to 1e-4
/// in six views: the trial's own, two along axes, and three random ones.
/// `each`: called for every picture.
void sweep(int fields, std::uint64_t seed, const std::function<void(const SweptPicture &)> &each);

} // namespace pellucid::bench
