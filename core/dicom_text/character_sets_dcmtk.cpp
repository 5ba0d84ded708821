// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/character_sets.h"

#include <sstream>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcchrstr.h>
#include <dcmtk/dcmdata/dcspchrs.h>
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
    const auto terms = termsOf({sets.data(), sets.size()});
    m_terms = {terms.begin(), terms.end()};
    if (usesIso2022(m_terms)) {
        m_first = terms.front();
        m_converter = Way::iso2022;
    } else {
        m_dcmtk = std::make_unique<DcmSpecificCharacterSet>();
        if (m_dcmtk->selectCharacterSet(sets).good())
            m_converter = Way::dcmtk;
    }
}

CharacterSets::~CharacterSets() = default;

std::string CharacterSets::utf8(const std::string &text, bool isName) const {
    switch (m_converter) {
    case Way::iso2022:
        return utf8OfIso2022(text, m_terms, m_first);
    case Way::dcmtk: {
        OFString to;
        if (m_dcmtk->convertString(text.c_str(), text.size(), to, isName ? "\\^=" : "\\").good())
            return {to.data(), to.size()};
        break;
    }
    case Way::none:
        break;
    }
    return text;
}

} // namespace pellucid::dicom_text
