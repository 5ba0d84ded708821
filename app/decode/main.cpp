// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes untrusted files. The other programs start it; it is of no use by itself.
#include <cstdio>
#include <exception>

#include "core/decoding/process/serve.h"
#include "core/platform/helper.h"
#include "core/platform/memory.h"

int main() {
    using namespace pellucid;
    platform::keepFreedMemory(); // an image's, for the next one
    auto ends = platform::takeHelpersEnds(platform::Given::channelAndFile);
    if (!ends) {
        std::fputs("pellucid-decode reads files for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    try {
        decoding::process::prepareToServe();
        return decoding::process::serve(*std::move(ends), decoding::process::confine());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-decode: %s\n", error.what());
        return 1;
    }
}
