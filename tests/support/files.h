// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace pellucid::test {

/// The contents of a file.
inline std::string readText(const std::filesystem::path &path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::byte> readBytes(const std::filesystem::path &path) {
    const std::string text = readText(path);
    const auto *const begin = reinterpret_cast<const std::byte *>(text.data());
    return {begin, begin + text.size()};
}

inline void writeText(const std::filesystem::path &path, const std::string &text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace pellucid::test
