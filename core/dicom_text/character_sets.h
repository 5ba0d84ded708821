// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

class DcmItem;

namespace pellucid::dicom_text {

/// Converts the texts of a dataset to UTF-8, each separately: one that violates the character sets
/// does not affect the others (PS3.5, 6.1 and annexes H to K).
class CharacterSets {
public:
    /// The character sets that the dataset names.
    explicit CharacterSets(DcmItem &dataset);

    /// Invalid characters become question marks. Where the dataset names a set that is unknown, or
    /// none, the text is returned as it is.
    std::string utf8(const std::string &text) const;

private:
    std::vector<std::string> m_terms;
};

} // namespace pellucid::dicom_text
