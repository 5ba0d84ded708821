// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/value_warnings.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using decoder::FrameHeader;
using decoder::InstanceHeader;

constexpr std::array<std::pair<decoder::Oddity, task::Because<1>>, 5> oddities{{
    {decoder::mislabelledEncoding, because::implicitLabelledExplicit},
    {decoder::definedLengthPixels, because::pixelsOfDefinedLength},
    {decoder::missingDelimiter, because::pixelsWithoutEnd},
    {decoder::otherPrecision, because::moreBitsThanDeclared},
    {decoder::unreadMosaic, because::mosaicsShownFlat},
}};

} // namespace

std::vector<task::Reason> warningsOfValues(const std::vector<const InstanceHeader *> &files) {
    std::vector<task::Reason> warnings;
    const auto count = [&](task::Because<1> what, const auto &has) {
        if (const auto n = std::count_if(files.begin(), files.end(),
                                         [&](const InstanceHeader *h) { return has(*h); });
            n > 0)
            warnings.push_back(what(n));
    };
    count(because::surplusPixels, decoder::hasSurplusPixels);
    count(because::zeroSlopes, [](const InstanceHeader &h) {
        return h.modalityTable.empty() &&
               std::any_of(h.frames.begin(), h.frames.end(),
                           [](const FrameHeader &f) { return f.rescale.isSlopeZero; });
    });
    for (const auto &[oddity, what] : oddities)
        count(what, [bit = oddity](const InstanceHeader &h) { return (h.oddities & bit) != 0; });
    return warnings;
}

bool isValueWarning(const task::Reason &warning) {
    return warning.is(because::surplusPixels) || warning.is(because::zeroSlopes) ||
           std::any_of(oddities.begin(), oddities.end(),
                       [&](const auto &odd) { return warning.is(odd.second); });
}

} // namespace pellucid::dicom
