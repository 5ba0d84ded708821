// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/document/study_view.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/classify/layers.h"

namespace pellucid::ui {

QStringList missingSegments(const classify::Look &look, const segment::SegmentSet *segments) {
    QStringList missing;
    for (const std::set<std::string> &needed : classify::segmentsOf(look))
        for (const std::string &name : needed)
            if (segments == nullptr || segments->find(name) == nullptr)
                missing << QString::fromStdString(name);
    missing.removeDuplicates();
    return missing;
}

void dropMissing(classify::Look &look, const segment::SegmentSet *segments) {
    const QStringList missing = missingSegments(look, segments);
    // A class that needs one through another is dropped, too.
    const auto needs = classify::segmentsOf(look);
    for (std::size_t n = look.classes.size(); n-- > 0;)
        if (std::any_of(needs[n].begin(), needs[n].end(), [&](const std::string &name) {
                return missing.contains(QString::fromStdString(name));
            }))
            look.classes.erase(look.classes.begin() + std::ptrdiff_t(n));
}

} // namespace pellucid::ui
