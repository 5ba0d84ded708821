// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/segment_set.h"

#include <fmt/format.h>

namespace pellucid::segment {

const Segment *SegmentSet::find(const std::string &name) const {
    for (const Segmentation &segmentation : m_segmentations)
        for (const Segment &segment : segmentation.segments)
            if (segment.name == name)
                return &segment;
    return nullptr;
}

std::string SegmentSet::titleOf(const std::string &name) const {
    for (const Segmentation &segmentation : m_segmentations)
        for (const Segment &segment : segmentation.segments)
            if (segment.name == name)
                return segmentation.title;
    return {};
}

std::size_t SegmentSet::bytes() const {
    std::size_t bytes = 0;
    for (const Segmentation &segmentation : m_segmentations)
        for (const Segment &segment : segmentation.segments)
            bytes += segment.coverage->shares.size();
    return bytes;
}

std::shared_ptr<const SegmentSet> SegmentSet::with(Segmentation added) const {
    for (Segment &segment : added.segments) {
        const std::string name = segment.name;
        for (int n = 2; find(segment.name) != nullptr; ++n)
            segment.name = fmt::format("{} ({})", name, n);
    }
    auto joined = std::make_shared<SegmentSet>(*this);
    joined->m_segmentations.push_back(std::move(added));
    return joined;
}

} // namespace pellucid::segment
