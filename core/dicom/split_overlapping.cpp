// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_overlapping.h"

#include <algorithm>

namespace pellucid::dicom {

namespace {

// Whether each pair shares at least half of the shorter one's extent.
bool overlap(const RepeatedFrames &frames, const FrameGroups &groups) {
    const auto first = [&](const FrameGroup &g) { return frames[g.frames.front()].depthMm; };
    const auto last = [&](const FrameGroup &g) { return frames[g.frames.back()].depthMm; };
    for (const FrameGroup &a : groups)
        for (const FrameGroup &b : groups) {
            const double shared = std::min(last(a), last(b)) - std::max(first(a), first(b));
            if (shared < 0.5 * std::min(last(a) - first(a), last(b) - first(b)))
                return false;
        }
    return true;
}

// The groups by an attribute of which each is a stack. Empty if there is none.
FrameGroups overlappingStacks(const RepeatedFrames &frames, const std::vector<Column> &columns) {
    for (const Column &column : columns) {
        FrameGroups groups = frames.byValue(frames.all(), column);
        const auto isStack = [&](const FrameGroup &group) {
            return frames.isEvenStack(group.frames);
        };
        if (groups.size() > 1 && std::all_of(groups.begin(), groups.end(), isStack) &&
            overlap(frames, groups))
            return groups;
    }
    return {};
}

} // namespace

std::vector<Part> splitOverlapping(const std::vector<PlacedFrame> &sorted,
                                   const ReadAttributes &read, const task::Progress &progress) {
    const RepeatedFrames frames(sorted, progress);
    FrameGroups groups = overlappingStacks(frames, headerColumns(sorted));
    if (groups.empty() && read)
        groups = overlappingStacks(frames, otherColumns(sorted, read, progress));
    return frames.partsOf(groups);
}

} // namespace pellucid::dicom
