// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace pellucid::test {

/// The folder of the real series; empty if they are absent.
inline std::filesystem::path testData() {
    const char *folder = std::getenv("PELLUCID_TEST_DATA");
    return folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path();
}

} // namespace pellucid::test

/// Skips a test, with the reason, if the real series are absent.
#define PELLUCID_NEEDS_TEST_DATA()                                                                 \
    if (pellucid::test::testData().empty())                                                        \
    GTEST_SKIP() << "PELLUCID_TEST_DATA is not set: the real series are absent"
