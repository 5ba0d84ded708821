// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/confined/packing.h"

namespace pellucid::confined {

void makeOneLine(std::string &text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20; }, ' ');
}

task::Reason unpackedReason(std::span<const std::byte> bytes, const task::Reason &refusal) {
    constexpr std::size_t longestReason = 2000; // a text of a header has up to 1024 bytes
    if (bytes.size() > longestReason)
        throw task::Error(task::ErrorCode::unusable, refusal);
    std::string text(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    // The encoding has no such bytes itself, and counts those of the texts.
    makeOneLine(text);
    auto reason = task::Reason::decoded(text);
    if (!reason)
        throw task::Error(task::ErrorCode::unusable, refusal);
    return *std::move(reason);
}

} // namespace pellucid::confined
