// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/temporary_folder.h"

namespace pellucid::test {

namespace fs = std::filesystem;

/// The command line of another system, which a variable names; null if the one built with the tests
/// is meant.
inline const char *programOfAnotherSystem() {
    return std::getenv("PELLUCID_CLI");
}

inline std::string program() {
    const char *const other = programOfAnotherSystem();
    return other != nullptr ? other : PELLUCID_CLI;
}

/// Skips a test, with the reason, if the program is for another system.
#define PELLUCID_NEEDS_THIS_SYSTEM(reason)                                                         \
    if (test::programOfAnotherSystem() != nullptr)                                                 \
    GTEST_SKIP() << "the program is for another system: " reason

inline CommandResult cli(const std::string &arguments, const std::string &before = "") {
    return run(before + " " + program() + " " + arguments);
}

inline std::string quoted(const fs::path &path) {
    return "'" + path.string() + "'";
}

inline std::vector<float> readNpy(const fs::path &path, int &height, int &width, int channels = 1) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    const auto shape = bytes.find("'shape': (");
    if (shape == std::string::npos ||
        std::sscanf(bytes.c_str() + shape, "'shape': (%d, %d)", &height, &width) != 2)
        return {};
    std::vector<float> samples(std::size_t(height) * std::size_t(width) * std::size_t(channels));
    std::memcpy(samples.data(), bytes.data() + bytes.size() - samples.size() * 4,
                samples.size() * 4);
    return samples;
}

inline std::size_t entries(const fs::path &folder) {
    return std::size_t(std::distance(fs::directory_iterator(folder), {}));
}

/// Expects a failure that is reported in one line, which names the program.
inline void expectOneLine(const CommandResult &r, int code, const std::string &part) {
    EXPECT_EQ(r.exitCode, code) << r.error;
    EXPECT_EQ(std::count(r.error.begin(), r.error.end(), '\n'), 1) << r.error;
    EXPECT_EQ(r.error.rfind("pellucid-cli: ", 0), 0U) << r.error;
    EXPECT_NE(r.error.find(part), std::string::npos) << r.error;
}

class Cli : public testing::Test {
protected:
    TemporaryFolder folder;
    fs::path phantomFolder(const std::string &options) {
        const fs::path path = folder / ("phantom" + std::to_string(m_count++));
        const auto r = cli("phantom " + quoted(path) + " " + options);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        return path;
    }
    // A grey picture of a series, as numbers.
    std::vector<float> picture(const fs::path &series, const std::string &options) {
        const fs::path out = folder / "picture.npy";
        const auto r = cli("render " + quoted(series) + " -o " + quoted(out) + " " + options);
        EXPECT_EQ(r.exitCode, 0) << r.error;
        int height = 0, width = 0;
        auto samples = readNpy(out, height, width);
        EXPECT_FALSE(samples.empty());
        return samples;
    }

private:
    int m_count = 0;
};

} // namespace pellucid::test
