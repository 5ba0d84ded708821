// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/serve.h"

#include "core/helper/confinement.h"
#include "core/system/memory.h"

namespace pellucid::parse {

int confine() {
    const bool holds = helper::limitResources({.memoryBytes = system::freeMemoryBytes()});
    const bool hasNoFiles = helper::forbidFiles();
    const bool isFiltered = helper::filterCalls();
    return (holds ? helper::limitsHold : 0) | (isFiltered ? helper::callsAreFiltered : 0) |
           (hasNoFiles ? helper::filesAreFiltered : 0);
}

} // namespace pellucid::parse
