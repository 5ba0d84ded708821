// SPDX-License-Identifier: GPL-3.0-or-later
// One program for all targets: PELLUCID_FUZZ_TARGET names the one that libFuzzer feeds.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/targets.h"

namespace {

pellucid::fuzz::Target chosen() {
    const char *const name = std::getenv("PELLUCID_FUZZ_TARGET");
    for (const auto &target : pellucid::fuzz::targets())
        if (name != nullptr && std::string_view(name) == target.name)
            return target.run;
    std::fputs("PELLUCID_FUZZ_TARGET names no target\n", stderr);
    std::exit(2);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    static const pellucid::fuzz::Target run = chosen();
    run({reinterpret_cast<const std::byte *>(data), size});
    return 0;
}
