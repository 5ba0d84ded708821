// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
    auto found = table.front();
    for (const auto &row : table)
        if (const auto &[word, meaning] = row; word == given)
            found = row;
    const auto &[word, meaning] = found;
    return meaning;
}

} // namespace pellucid::cli
