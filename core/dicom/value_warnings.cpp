// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/value_warnings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoding::FrameHeader;
using decoding::InstanceHeader;

constexpr std::array<std::pair<decoding::Oddity, task::Because<1>>, 10> oddities{{
    {decoding::mislabelledEncoding, because::implicitLabelledExplicit},
    {decoding::definedLengthPixels, because::pixelsOfDefinedLength},
    {decoding::missingDelimiter, because::pixelsWithoutEnd},
    {decoding::otherPrecision, because::moreBitsThanDeclared},
    {decoding::unreadMosaic, because::mosaicsShownFlat},
    {decoding::guessedMosaic, because::mosaicTilesGuessed},
    {decoding::placedBySpacing, because::placedBySpacing},
    {decoding::placedByThickness, because::placedByThickness},
    {decoding::decimalCommas, because::decimalCommas},
    {decoding::numbersOfWrongType, because::numbersOfWrongType},
}};

// What images of one volume should agree on, by the attribute's name. Empty: not stated.
struct Agreement {
    const char *name;
    std::string (*value)(const InstanceHeader &);
};

template <std::uint32_t tag> std::string dimensionOf(const InstanceHeader &header) {
    const auto &dimensions = header.frames.front().dimensions;
    const auto at = dimensions.find(tag);
    if (at == dimensions.end())
        return {};
    // "80.0" is 80.
    const std::string &text = at->second;
    const char *const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    double number = 0.0;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? fmt::format("{}", number)
                                                                    : text;
}

constexpr std::array agreements{
    Agreement{"SOP Class", [](const InstanceHeader &h) { return h.sopClassName; }},
    Agreement{"Units", [](const InstanceHeader &h) { return h.pet ? h.pet->units : ""; }},
    Agreement{"Rescale Type", [](const InstanceHeader &h) { return h.rescaleType; }},
    Agreement{"Photometric Interpretation", [](const InstanceHeader &h) { return h.photometric; }},
    Agreement{
        "Presentation LUT Shape",
        [](const InstanceHeader &h) { return std::string(h.isInverse ? "INVERSE" : "IDENTITY"); }},
    Agreement{"Patient's Birth Date", [](const InstanceHeader &h) { return h.birthDate; }},
    Agreement{"Patient's Sex", [](const InstanceHeader &h) { return h.sex; }},
    Agreement{"Convolution Kernel", dimensionOf<0x00181210>},
    Agreement{"KVP", dimensionOf<0x00180060>},
};

std::vector<task::Reason> disagreementsOf(const std::vector<const InstanceHeader *> &files) {
    std::vector<task::Reason> disagreements;
    for (const Agreement &agreement : agreements) {
        std::set<std::string> values;
        for (const InstanceHeader *file : files)
            values.insert(agreement.value(*file));
        values.erase(""); // not stated
        if (values.size() > 1)
            disagreements.push_back(because::disagreementIn(
                agreement.name, fmt::format("{}", fmt::join(values, ", "))));
    }
    return disagreements;
}

} // namespace

std::vector<task::Reason> warningsOfValues(const std::vector<const InstanceHeader *> &files) {
    std::vector<task::Reason> warnings;
    const auto count = [&](task::Because<1> what, const auto &has) {
        if (const auto n = std::count_if(files.begin(), files.end(),
                                         [&](const InstanceHeader *h) { return has(*h); });
            n > 0)
            warnings.push_back(what(n));
    };
    count(because::surplusPixels, decoding::hasSurplusPixels);
    count(because::zeroSlopes, [](const InstanceHeader &h) {
        return h.modalityTable.empty() &&
               std::any_of(h.frames.begin(), h.frames.end(),
                           [](const FrameHeader &f) { return f.rescale.isSlopeZero; });
    });
    for (const auto &[oddity, what] : oddities)
        count(what, [bit = oddity](const InstanceHeader &h) { return (h.oddities & bit) != 0; });
    if (std::vector<task::Reason> disagreements = disagreementsOf(files); !disagreements.empty())
        warnings.push_back(because::imagesDisagree(std::move(disagreements)));
    return warnings;
}

bool isValueWarning(const task::Reason &warning) {
    return warning.is(because::surplusPixels) || warning.is(because::zeroSlopes) ||
           warning.is(because::imagesDisagree) ||
           std::any_of(oddities.begin(), oddities.end(),
                       [&](const auto &odd) { return warning.is(odd.second); });
}

} // namespace pellucid::dicom
