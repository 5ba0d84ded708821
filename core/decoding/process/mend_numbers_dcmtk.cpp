// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decoding/process/mend_numbers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "core/decoding/client/instance.h"
#include "core/dicom_text/attributes.h"

namespace pellucid::decoding::process {

using namespace dicom_text;

namespace {

std::vector<std::string> splitAt(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

// The number of values of points and sizes; 0: any.
std::size_t valuesOf(const DcmTagKey &tag) {
    return tag == DCM_PixelSpacing || tag == DCM_ImagerPixelSpacing ? 2
           : tag == DCM_ImagePositionPatient                        ? 3
           : tag == DCM_ImageOrientationPatient                     ? 6
                                                                    : 0;
}

// A comma may separate values, or whole numbers from their decimals. Where it does both, there are
// twice as many numbers as values.
std::optional<std::string> mendedPairs(const std::string &text, std::size_t values) {
    const std::vector<std::string> parts = splitAt(text, ',');
    if (values == 0 || parts.size() != 2 * values || text.find('\\') != text.npos)
        return std::nullopt;
    std::string all;
    for (std::size_t n = 0; n < parts.size(); n += 2) {
        const std::string value = parts[n] + "." + parts[n + 1];
        if (!numberIn(value) || parts[n + 1].find_first_not_of("0123456789 ") != std::string::npos)
            return std::nullopt;
        all += (all.empty() ? "" : "\\") + value;
    }
    return all;
}

// The values of a decimal string; nothing if they are no numbers, however written.
std::optional<std::string> mended(const std::string &text) {
    std::string all;
    for (const std::string &value : splitAt(text, '\\')) {
        std::string decimal = value;
        if (std::count(value.begin(), value.end(), ',') == 1)
            std::replace(decimal.begin(), decimal.end(), ',', '.');
        std::vector<std::string> parts{decimal};
        if (!numberIn(decimal))
            parts = splitAt(value, ',');
        for (const std::string &part : parts) {
            if (!numberIn(part))
                return std::nullopt;
            all += (all.empty() ? "" : "\\") + part;
        }
    }
    return all;
}

// What an element's text is, whatever its value representation.
std::string textOf(DcmElement &element) {
    if (element.ident() == EVR_UN || element.ident() == EVR_OB) {
        Uint8 *bytes = nullptr;
        if (element.getUint8Array(bytes).bad() || bytes == nullptr)
            return {};
        const std::string text(reinterpret_cast<const char *>(bytes), element.getLengthField());
        return text.substr(0, text.find('\0'));
    }
    OFString text;
    return element.getOFStringArray(text).good() ? std::string(text.c_str()) : std::string();
}

bool isTextOrBytes(DcmEVR type) {
    switch (type) {
    case EVR_CS:
    case EVR_LO:
    case EVR_LT:
    case EVR_OB:
    case EVR_SH:
    case EVR_ST:
    case EVR_UC:
    case EVR_UN:
    case EVR_UT:
        return true;
    default:
        return false;
    }
}

// An element that has to be replaced, and its values.
struct Mended {
    DcmItem *parent;
    DcmTagKey tag;
    std::string values;
};

} // namespace

std::uint32_t mendNumbers(DcmItem &dataset) {
    std::uint32_t oddities = 0;
    std::vector<Mended> all;
    DcmStack stack;
    while (dataset.nextObject(stack, OFTrue).good()) {
        auto *const element = dynamic_cast<DcmElement *>(stack.top());
        auto *const parent = dynamic_cast<DcmItem *>(stack.elem(1));
        if (element == nullptr || parent == nullptr || !element->isLeaf())
            continue;
        const DcmTagKey tag = element->getTag();
        const bool isNumber = element->ident() == EVR_DS;
        if (!isNumber && (!isTextOrBytes(element->ident()) || (tag.getGroup() & 1) != 0 ||
                          DcmTag(tag).getEVR() != EVR_DS))
            continue;
        const std::string text = textOf(*element);
        const bool hasComma = text.find(',') != std::string::npos;
        if (isNumber && !hasComma)
            continue;
        auto values = mendedPairs(text, valuesOf(tag));
        if (!values)
            values = mended(text);
        if (values) {
            oddities |= (hasComma ? decimalCommas : 0U) | (isNumber ? 0U : numbersOfWrongType);
            all.push_back({parent, tag, std::move(*values)});
        }
    }
    for (const Mended &one : all)
        one.parent->putAndInsertString(DcmTag(one.tag, EVR_DS), one.values.c_str());
    return oddities;
}

} // namespace pellucid::decoding::process
