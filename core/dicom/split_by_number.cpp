// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_by_number.h"

#include <algorithm>
#include <tuple>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace because = task::because;

FrameGroups splitByNumber(const RepeatedFrames &frames) {
    FrameIndices byNumber = frames.all();
    const auto number = [&](std::size_t n) {
        return std::tuple(frames[n].instanceNumber, frames[n].reference.frame);
    };
    std::stable_sort(byNumber.begin(), byNumber.end(),
                     [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
    std::vector<std::size_t> met(frames.positions()), setOf(frames.all().size());
    bool runsByPart = true, runsByPlace = true;
    std::size_t set = 0;
    for (std::size_t n = 0; n < byNumber.size(); ++n) {
        const std::size_t frame = byNumber[n], place = frames.positionOf(frame);
        if (n > 0) {
            if (number(byNumber[n - 1]) == number(frame))
                return {};
            const bool isSamePlace = frames.positionOf(byNumber[n - 1]) == place;
            runsByPlace = runsByPlace && (isSamePlace || met[place] == 0);
        }
        // A set ends where a position comes again.
        runsByPart = runsByPart && met[place] + 1 >= set;
        setOf[frame] = met[place]++;
        set = std::max(set, met[place]);
    }
    // Without one image, those of its position would count for another set.
    const bool isWhole = frames.repeatsOfEach(frames.all()) == frames.mostRepeats();
    if (!runsByPart && !(runsByPlace && isWhole))
        return {};
    FrameGroups groups(frames.mostRepeats());
    for (const std::size_t frame : frames.all())
        groups[setOf[frame]].frames.push_back(frame);
    for (std::size_t n = 0; n < groups.size(); ++n)
        groups[n].label = {because::set(n + 1)};
    return groups;
}

} // namespace pellucid::dicom
