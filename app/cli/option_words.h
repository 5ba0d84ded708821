// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

namespace pellucid::cli {

/// The words of a table of words and meanings, for CLI::IsMember.
template <class Table> std::vector<std::string> wordsOf(const Table &table) {
    std::vector<std::string> words;
    for (const auto &[word, meaning] : table)
        words.emplace_back(word);
    return words;
}

/// The meaning of one of these words. *Requires*: the table has the word.
template <class Table> auto meaningOf(const std::string &given, const Table &table) {
    const auto row = std::find_if(table.begin(), table.end(), [&](const auto &candidate) {
        const auto &[word, meaning] = candidate;
        return word == given;
    });
    assert(row != table.end());
    const auto &[word, meaning] = *row;
    return meaning;
}

} // namespace pellucid::cli
