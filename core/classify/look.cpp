// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/classify/look.h"

#include <algorithm>
#include <iterator>

#include "core/task/error.h"

namespace pellucid::classify {

std::vector<TissueClass> visibleClasses(const Look &look) {
    std::vector<TissueClass> shown;
    std::copy_if(look.classes.begin(), look.classes.end(), std::back_inserter(shown),
                 [](const TissueClass &tissue) { return tissue.weight > 0.0; });
    return shown;
}

bool mixesColors(const Look &look) {
    const auto shown = visibleClasses(look);
    return std::any_of(shown.begin(), shown.end(), [&](const TissueClass &tissue) {
        return tissue.color != shown.front().color;
    });
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
