// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/character_sets.h"

#include <sstream>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/dicom_text/iso2022.h"

namespace pellucid::dicom_text {

namespace {

// The values of SpecificCharacterSet; some may be empty.
std::vector<std::string> termsOf(const std::string &sets) {
    std::vector<std::string> terms;
    std::istringstream each(sets);
    for (std::string term; std::getline(each, term, '\\');) {
        const auto first = term.find_first_not_of(' '), last = term.find_last_not_of(' ');
        terms.push_back(first == std::string::npos ? "" : term.substr(first, last - first + 1));
    }
    return terms;
}

} // namespace

CharacterSets::CharacterSets(DcmItem &dataset) {
    OFString sets;
    if (dataset.findAndGetOFStringArray(DCM_SpecificCharacterSet, sets).bad() || sets.empty())
        return;
    auto terms = termsOf({sets.data(), sets.size()});
    if (areKnown(terms))
        m_terms = std::move(terms);
}

std::string CharacterSets::utf8(const std::string &text) const {
    return m_terms.empty() ? text : utf8OfSets(text, m_terms);
}

} // namespace pellucid::dicom_text
