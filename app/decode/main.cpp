// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes untrusted files. The other programs start it; it is of no use by itself.
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include "core/confined/process.h"
#include "core/decoding/process/serve.h"

int main() {
    using namespace pellucid;
    // Keep an image's memory for the next one. Returning it to the system costs a page fault for
    // every 4 KB, which took five times as long as decoding a plain slice.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
    if (::fcntl(confined::socketDescriptor, F_GETFD) < 0 ||
        ::fcntl(confined::fileDescriptor, F_GETFD) < 0) {
        std::fputs("pellucid-decode reads files for Pellucid and is started by it.\n", stderr);
        return 2;
    }
    // Close every other file that the parent left open.
    ::close_range(confined::fileDescriptor + 1, ~0U, 0);
    try {
        decoding::process::prepareToServe();
        return decoding::process::serve(confined::socketDescriptor, confined::fileDescriptor,
                                        decoding::process::confine());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "pellucid-decode: %s\n", error.what());
        return 1;
    }
}
