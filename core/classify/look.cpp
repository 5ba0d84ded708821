// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look.h"

#include <algorithm>
#include <iterator>

#include "core/task/error.h"

namespace pellucid::classify {

bool haveRegions(const std::vector<TissueClass> &classes) {
    return std::any_of(classes.begin(), classes.end(),
                       [](const TissueClass &tissue) { return !tissue.isRange(); });
}

std::vector<TissueClass> visibleClasses(const Look &look) {
    std::vector<TissueClass> shown;
    std::copy_if(look.classes.begin(), look.classes.end(), std::back_inserter(shown),
                 [](const TissueClass &tissue) { return tissue.weight > 0.0; });
    return shown;
}

ColorBasis colorBasisOf(const Look &look) {
    std::vector<ColorBasis::Rgb> colors;
    for (const TissueClass &tissue : visibleClasses(look))
        colors.push_back({tissue.color.red, tissue.color.green, tissue.color.blue});
    // Black classes show nothing.
    const ColorBasis::Rgb black{}, white{1.0, 1.0, 1.0};
    if (std::all_of(colors.begin(), colors.end(), [&](const auto &c) { return c == black; })) {
        const std::vector<ColorBasis::Rgb> amounts(colors.size());
        return {{colors.empty() ? white : black}, amounts};
    }
    return colorBasis(colors);
}

std::size_t channelsOf(const Look &look) {
    return colorBasisOf(look).colors.size();
}

bool isGrey(const Look &look) {
    const auto shown = visibleClasses(look);
    return std::all_of(shown.begin(), shown.end(),
                       [](const TissueClass &tissue) { return tissue.color == Color{}; });
}

void validate(const Look &look) {
    validate(look.transferFunction);
    if (look.classes.size() > maxClasses)
        throw task::Error(task::ErrorCode::usage,
                          task::because::tooManyClasses(look.classes.size(), maxClasses));
    for (const TissueClass &tissue : look.classes)
        validate(tissue);
}

} // namespace pellucid::classify
