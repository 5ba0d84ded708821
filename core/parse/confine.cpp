// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parse/serve.h"

#include "core/helper/confinement.h"
#include "core/system/memory.h"

namespace pellucid::parse {

int confine() {
    return helper::confine({.memoryBytes = system::freeMemoryBytes()});
}

} // namespace pellucid::parse
