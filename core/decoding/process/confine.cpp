// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/serve.h"

#include "core/platform/confinement.h"
#include "core/platform/memory.h"

namespace pellucid::decoding::process {

int confine() {
    return platform::confine({.memoryBytes = platform::freeMemoryBytes()});
}

} // namespace pellucid::decoding::process
