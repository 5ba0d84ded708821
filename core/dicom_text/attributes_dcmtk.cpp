// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom_text/attributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

namespace pellucid::dicom_text {

namespace {

// Long values are not shown anywhere.
constexpr std::size_t longestText = 1024; // in bytes; DICOM's longest texts have 10240 characters

} // namespace

std::optional<double> numberIn(std::string_view text) {
    const auto isPadding = [](char c) { return c == ' ' || c == '\0'; };
    while (!text.empty() && isPadding(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isPadding(text.back()))
        text.remove_suffix(1);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber =
        error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    return isNumber ? std::optional(value) : std::nullopt;
}

std::string oneLine(std::string text) {
    if (text.size() > longestText) {
        std::size_t end = longestText;
        while (end > 0 && (text[end] & 0xC0) == 0x80) // not within a character
            --end;
        text.resize(end);
    }
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (unsigned char)(c) < 0x20 || c == 0x7F; },
        ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text;
}

std::string readText(DcmItem *item, const DcmTagKey &tag, const CharacterSets *sets) {
    OFString value;
    if (item == nullptr || item->findAndGetOFStringArray(tag, value).bad())
        return {};
    const auto first = value.find_first_not_of(" \0");
    if (first == OFString_npos)
        return {};
    const std::string written(value.c_str() + first);
    return oneLine(sets != nullptr ? sets->utf8(written) : written);
}

std::vector<double> readNumbers(DcmItem *item, const DcmTagKey &tag, std::size_t maxCount) {
    // Read as text, whatever the type: each typed getter of DCMTK accepts only one value
    // representation.
    std::vector<double> values;
    DcmElement *element = nullptr;
    if (item == nullptr || item->findAndGetElement(tag, element).bad())
        return values;
    OFString value;
    while (values.size() < maxCount &&
           element->getOFString(value, static_cast<unsigned long>(values.size())).good()) {
        const auto parsed = numberIn({value.data(), value.size()});
        if (!parsed)
            break;
        values.push_back(*parsed);
    }
    return values;
}

std::optional<double> readNumber(DcmItem *item, const DcmTagKey &tag) {
    const auto values = readNumbers(item, tag, 1);
    return values.empty() ? std::nullopt : std::optional(values[0]);
}

int readInteger(DcmItem *item, const DcmTagKey &tag, int fallback) {
    const auto value = readNumber(item, tag);
    return value && std::abs(*value) < 2e9 ? int(*value) : fallback;
}

DcmItem *sequenceItem(DcmItem *item, const DcmTagKey &tag) {
    DcmItem *found = nullptr;
    if (item == nullptr || item->findAndGetSequenceItem(tag, found).bad())
        return nullptr;
    return found;
}

} // namespace pellucid::dicom_text
