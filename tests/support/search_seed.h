// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

namespace pellucid::test {

/// The seed of random inputs: the same in every run, so that a test fails only after a change.
/// `./dev search` looks for counterexamples with others, by PELLUCID_TEST_SEED.
inline std::uint64_t searchSeed() {
    const char *const asked = std::getenv("PELLUCID_TEST_SEED");
    const std::uint64_t seed = asked != nullptr ? std::stoull(asked) : 20071;
    std::cout << "random inputs; to repeat them: PELLUCID_TEST_SEED=" << seed << '\n';
    return seed;
}

} // namespace pellucid::test
