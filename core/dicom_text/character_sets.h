// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
#include <string>

class DcmItem;
class DcmSpecificCharacterSet;

namespace pellucid::dicom_text {

/// Converts the texts of a dataset to UTF-8, each separately: one that violates the character sets
/// does not affect the others (PS3.5, 6.1 and annexes H to K).
class CharacterSets {
public:
    /// The character sets that the dataset names.
    explicit CharacterSets(DcmItem &dataset);
    ~CharacterSets();
    CharacterSets(const CharacterSets &) = delete;
    CharacterSets &operator=(const CharacterSets &) = delete;

    /// *Shape*: `isName`: a person name, in which ^ and = separate components. A text that violates
    /// the character sets is returned unchanged; in those of iso2022.h invalid characters become
    /// question marks.
    std::string utf8(const std::string &text, bool isName) const;

private:
    enum class Way { none, dcmtk, iso2022 };
    Way m_converter = Way::none;
    std::set<std::string> m_terms;
    std::string m_first; ///< the first one
    std::unique_ptr<DcmSpecificCharacterSet> m_dcmtk;
};

} // namespace pellucid::dicom_text
