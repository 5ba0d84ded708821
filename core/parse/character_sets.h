// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

class DcmItem;
class DcmSpecificCharacterSet;

namespace pellucid::parse {

/// What turns the texts of a dataset into UTF-8, each by itself: one that is not what the character
/// sets say keeps no other from being read (PS3.5, 6.1 and annexes H to K).
class CharacterSets {
public:
    /// Those that the dataset names.
    explicit CharacterSets(DcmItem &dataset);
    ~CharacterSets();
    CharacterSets(const CharacterSets &) = delete;
    CharacterSets &operator=(const CharacterSets &) = delete;

    /// *Shape*: `isName`: a person's, in which ^ and = begin a new part. A text that is not what
    /// the character sets say stays as it is; Japanese and Latin 9 get question marks for what is
    /// none.
    std::string utf8(const std::string &text, bool isName) const;

private:
    // Of DCMTK; or of what DCMTK asks the system for by names that glibc does not have.
    enum class Way { none, dcmtk, japanese, latin9 };
    Way m_way = Way::none;
    std::unique_ptr<DcmSpecificCharacterSet> m_dcmtk;
};

} // namespace pellucid::parse
