// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder as it is on a system that confines nothing.
#include "core/confined/confinement.h"
#include "core/confined/process.h"
#include "core/decoding/process/serve.h"

int main() {
    using namespace pellucid;
    decoding::process::prepareToServe();
    return decoding::process::serve(confined::socketDescriptor, confined::fileDescriptor,
                                    confined::limitsHold);
}
