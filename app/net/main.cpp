// SPDX-License-Identifier: GPL-3.0-or-later
// Speaks to one server or client on the network. The other programs start it; it is of no use by
// itself.
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <unistd.h>

#include "core/helper/process.h"
#include "core/network/serve.h"

int main() {
    using namespace pellucid;
    if (::fcntl(helper::socketDescriptor, F_GETFD) < 0) {
        std::fputs("pellucid-net talks to servers for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    // Close every other file that the parent left open.
    ::close_range(helper::socketDescriptor + 1, ~0U, 0);
    try {
        network::prepareToServe();
        return network::serve(helper::socketDescriptor);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-net: %s\n", error.what());
        return 1;
    }
}
