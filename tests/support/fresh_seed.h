// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

namespace pellucid::test {

/// A seed for fields that no margin was fitted to: a different one each day, the same all day.
/// PELLUCID_TEST_SEED repeats the run of another day; the seed is printed for that.
inline std::uint64_t freshSeed() {
    const char *const asked = std::getenv("PELLUCID_TEST_SEED");
    const auto today =
        std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()).time_since_epoch();
    const std::uint64_t seed = asked != nullptr ? std::stoull(asked) : std::uint64_t(today.count());
    std::cout << "fields of today; to repeat them: PELLUCID_TEST_SEED=" << seed << '\n';
    return seed;
}

} // namespace pellucid::test
