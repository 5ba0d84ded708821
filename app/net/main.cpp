// SPDX-License-Identifier: GPL-3.0-or-later
// Speaks to one server or client on the network. The other programs start it; it is of no use by
// itself.
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <unistd.h>

#include "core/confined/process.h"
#include "core/network/process/serve.h"

int main() {
    using namespace pellucid;
    if (::fcntl(confined::socketDescriptor, F_GETFD) < 0) {
        std::fputs("pellucid-net talks to servers for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    // Close every other file that the parent left open.
    ::close_range(confined::socketDescriptor + 1, ~0U, 0);
    try {
        network::process::prepareToServe();
        return network::process::serve(confined::socketDescriptor);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-net: %s\n", error.what());
        return 1;
    }
}
