// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/serve.h"

#include "core/confined/confinement.h"
#include "core/system/memory.h"

namespace pellucid::decoding::process {

int confine() {
    return confined::confine({.memoryBytes = system::freeMemoryBytes()});
}

} // namespace pellucid::decoding::process
