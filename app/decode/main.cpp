// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes what nobody vouches for; started by the other programs, of no use to people.
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include "core/decoder/channel.h"
#include "core/parse/serve.h"

int main() {
    using namespace pellucid;
    // An image's memory is kept for the next one: given back to the system, it would cost a page
    // fault for every 4 KB each time, which took five times as long as decoding a plain slice.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
    if (::fcntl(decoder::socketDescriptor, F_GETFD) < 0 ||
        ::fcntl(decoder::arenaDescriptor, F_GETFD) < 0) {
        std::fputs("pellucid-decode reads files for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    // Whatever the program left open is none of this one's business.
    ::close_range(decoder::arenaDescriptor + 1, ~0U, 0);
    try {
        parse::prepareToServe();
        return parse::serve(decoder::socketDescriptor, decoder::arenaDescriptor, parse::confine());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-decode: %s\n", error.what());
        return 1;
    }
}
