// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/task/reason.h"

namespace pellucid::cli {

/// A file or an object, and what happened to it.
struct Named {
    std::string name;
    task::Reason reason;
};

/// One line for each different reason, in the order of their first names. `what` happened: "not
/// sent". *Shape*: "NAME: not sent: REASON" for a single name; "5 not sent: REASON: A, B, C and 2
/// others" for several.
std::vector<std::string> linesByReason(const std::vector<Named> &all, const std::string &what);

} // namespace pellucid::cli
