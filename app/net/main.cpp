// SPDX-License-Identifier: GPL-3.0-or-later
// Speaks to one server or client on the network. The other programs start it; it is of no use by
// itself.
#include <cstdio>
#include <exception>

#include "core/network/process/serve.h"
#include "core/platform/helper.h"

int main() {
    using namespace pellucid;
    auto ends = platform::takeHelpersEnds(platform::Given::channel);
    if (!ends) {
        std::fputs("pellucid-net talks to servers for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    try {
        network::process::prepareToServe();
        return network::process::serve(ends->channel);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-net: %s\n", error.what());
        return 1;
    }
}
