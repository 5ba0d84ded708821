// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::decoding {

/// An attribute of a DICOM file, or an item of a sequence, in words.
struct Attribute {
    int depth = 0; ///< 0: of the data set; an item and its attributes are deeper than its sequence
    std::uint32_t tag = 0; ///< group in the upper, element in the lower 16 bits; of an item 0
    std::string vr;        ///< value representation, such as "LO"; of an item empty
    std::string name;      ///< as the data dictionary calls it; of an item its number
    std::string value;     ///< on one line, at most 1024 bytes; of bulk data their size
    bool operator==(const Attribute &) const = default;
};

/// The attributes of a file in its order: meta header first, sequences before their items.
struct AttributeList {
    std::vector<Attribute> attributes;
    bool isComplete = true; ///< false: there are more, or the rest of the file is damaged
};

inline constexpr std::size_t maxAttributes = 50000; ///< of a list
inline constexpr int maxAttributeDepth = 64;

/// "(0010,0020)"; nothing for an item.
std::string tagText(const Attribute &attribute);

} // namespace pellucid::decoding
