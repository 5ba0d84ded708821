// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_repeats.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/dicom/place_columns.h"
#include "core/dicom/reasons.h"
#include "core/dicom/split_by_number.h"
#include "core/dicom/split_exactly.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

// By as many attributes as it takes until no position repeats in a group. Empty if that makes more
// groups than there are repeats.
FrameGroups refined(const RepeatedFrames &frames, const std::vector<Column> &columns) {
    FrameGroups groups{{{}, frames.all()}};
    for (const Column &column : columns) {
        FrameGroups finer;
        for (const FrameGroup &group : groups) {
            if (!frames.repeats(group.frames)) {
                finer.push_back(group);
                continue;
            }
            for (const FrameGroup &one : frames.byValue(group.frames, column))
                finer.push_back(within(group, one));
        }
        if (finer.size() > groups.size() && finer.size() <= frames.mostRepeats())
            groups = std::move(finer);
    }
    const bool isSplit = groups.size() == frames.mostRepeats() &&
                         std::none_of(groups.begin(), groups.end(), [&](const FrameGroup &group) {
                             return frames.repeats(group.frames);
                         });
    return isSplit ? groups : FrameGroups();
}

// Where slices are missing: as many groups as repeats, or groups that are each a stack. Empty if
// these attributes do not separate the frames.
FrameGroups splitRoughly(const RepeatedFrames &frames, const std::vector<Column> &columns) {
    if (FrameGroups groups = refined(frames, columns); !groups.empty())
        return groups;
    for (const Column &column : columns) {
        FrameGroups groups = frames.byValue(frames.all(), column);
        if (groups.size() > 1 &&
            std::all_of(groups.begin(), groups.end(), [&](const FrameGroup &group) {
                return !frames.repeats(group.frames) && frames.isEvenStack(group.frames);
            }))
            return groups;
    }
    return {};
}

// Whether two splits differ in nothing but the names of their groups.
bool areAlike(const FrameGroups &a, const FrameGroups &b) {
    const auto has = [](const FrameGroups &groups, const FrameGroup &one) {
        return std::any_of(groups.begin(), groups.end(), [&](const FrameGroup &group) {
            return std::is_permutation(group.frames.begin(), group.frames.end(), one.frames.begin(),
                                       one.frames.end());
        });
    };
    return a.size() == b.size() &&
           std::all_of(a.begin(), a.end(), [&](const FrameGroup &group) { return has(b, group); });
}

} // namespace

bool hasRepeatedPositions(const std::vector<PlacedFrame> &sorted) {
    return std::adjacent_find(sorted.begin(), sorted.end(), sameDepth) != sorted.end();
}

std::vector<Part> splitRepeats(const std::vector<PlacedFrame> &sorted, const ReadAttributes &read,
                               const task::Progress &progress) {
    const RepeatedFrames frames(sorted, progress);
    std::vector<Column> columns, shifts;
    for (PlaceColumn &place : placeColumns(sorted))
        (place.isApart ? columns : shifts).push_back(std::move(place.column));
    const auto add = [&](std::vector<Column> more) {
        std::move(more.begin(), more.end(), std::back_inserter(columns));
    };
    add(headerColumns(sorted));
    // An attribute that is constant throughout a volume is stronger evidence than a time that
    // drifts. All attributes of the files are tried before a drift counts.
    FrameGroups groups = splitExactly(frames, columns, Telling::byValue);
    if (groups.empty()) {
        const FrameGroups drifting = splitExactly(frames, columns, Telling::alsoByRank);
        FrameGroups roughly = drifting.empty() ? splitRoughly(frames, columns) : FrameGroups();
        if (read && roughly.empty()) {
            add(otherColumns(sorted, read, progress));
            groups = splitExactly(frames, columns, Telling::byValue);
        }
        // The drift names the volumes better, if it means the same ones.
        if (!drifting.empty() && (groups.empty() || areAlike(groups, drifting)))
            groups = drifting;
        if (groups.empty())
            groups = std::move(roughly);
        if (groups.empty())
            groups = splitExactly(frames, columns, Telling::alsoByRank);
        if (groups.empty())
            groups = splitRoughly(frames, columns);
    }
    // Where one thing moves, an attribute says more about a part than its place.
    if (groups.empty() && !shifts.empty()) {
        add(std::move(shifts));
        groups = splitExactly(frames, columns, Telling::alsoByRank);
        if (groups.empty())
            groups = splitRoughly(frames, columns);
    }
    if (!groups.empty())
        return frames.partsOf(groups);
    std::vector<Part> parts = frames.partsOf(splitByNumber(frames));
    for (Part &part : parts)
        part.warnings = {because::toldApartByNumber};
    return parts;
}

} // namespace pellucid::dicom
