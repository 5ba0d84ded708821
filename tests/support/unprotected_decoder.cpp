// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder as it is on a system that confines nothing.
#include "core/decoding/process/serve.h"
#include "core/platform/confinement.h"
#include "core/platform/helper.h"

int main() {
    using namespace pellucid;
    auto ends = platform::takeHelpersEnds(platform::Given::channelAndFile);
    decoding::process::prepareToServe();
    return decoding::process::serve(*std::move(ends), platform::limitsHold);
}
