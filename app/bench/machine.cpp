// SPDX-License-Identifier: GPL-3.0-or-later
#include <thread>

#include "app/bench/report.h"
#include "core/platform/process.h"

namespace pellucid::bench {

Machine thisMachine() {
    const platform::Machine here = platform::thisMachine();
    return {.processor = here.processor,
            .system = here.system,
            .threads = int(std::thread::hardware_concurrency()),
            .memoryGiB = double(here.memoryBytes) / double(1 << 30)};
}

} // namespace pellucid::bench
