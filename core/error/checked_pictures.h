// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace pellucid::error {

/// The pictures of a series whose errors are measured: none; each single picture, and the first,
/// the last and six others of a longer series; or all.
enum class CheckedPictures { none, rest, all };

/// The words for them in recipes and options.
inline constexpr std::array<std::pair<const char *, CheckedPictures>, 3> checkedPictures{
    {{"none", CheckedPictures::none},
     {"rest", CheckedPictures::rest},
     {"all", CheckedPictures::all}}};

/// *Shape*: `picture` from 0 to `count` - 1.
inline bool isChecked(CheckedPictures which, std::size_t picture, std::size_t count) {
    constexpr std::size_t most = 8;
    if (which != CheckedPictures::rest || count <= most)
        return which != CheckedPictures::none;
    // Multiples of (count - 1)/(most - 1), rounded down.
    const std::size_t of = (picture * (most - 1) + count - 2) / (count - 1);
    return of * (count - 1) / (most - 1) == picture;
}

} // namespace pellucid::error
