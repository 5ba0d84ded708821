// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/serve.h"

#include "core/confined/confinement.h"
#include "core/platform/memory.h"

namespace pellucid::decoding::process {

int confine() {
    return confined::confine({.memoryBytes = platform::freeMemoryBytes()});
}

} // namespace pellucid::decoding::process
