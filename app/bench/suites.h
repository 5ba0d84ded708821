// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "app/bench/report.h"

namespace pellucid::bench {

/// Phantoms and noise at 64^3 to 256^3 in the default quality: seconds to run, time beside error.
std::vector<Row> runQuickSuite();

} // namespace pellucid::bench
