// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
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
    /// the character sets say stays as it is; those of iso2022.h get question marks for what is no
    /// letter.
    std::string utf8(const std::string &text, bool isName) const;

private:
    enum class Way { none, dcmtk, iso2022 };
    Way m_way = Way::none;
    std::set<std::string> m_terms;
    std::string m_first; ///< of them
    std::unique_ptr<DcmSpecificCharacterSet> m_dcmtk;
};

} // namespace pellucid::parse
