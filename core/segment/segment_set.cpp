// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/segment_set.h"

#include <set>
#include <utility>

#include "core/system/text.h"

namespace pellucid::segment {

const SegmentSet::Place *SegmentSet::placeOf(const std::string &name) const {
    const auto found = m_places.find(name);
    return found == m_places.end() ? nullptr : &found->second;
}

const Segment *SegmentSet::find(const std::string &name) const {
    const Place *const place = placeOf(name);
    return place == nullptr ? nullptr
                            : &m_segmentations[place->segmentation].segments[place->segment];
}

const Segmentation *SegmentSet::fileOf(const std::string &name) const {
    const Place *const place = placeOf(name);
    return place == nullptr ? nullptr : &m_segmentations[place->segmentation];
}

std::size_t SegmentSet::bytes() const {
    std::size_t bytes = 0;
    for (const Segmentation &segmentation : m_segmentations)
        for (const Segment &segment : segmentation.segments)
            bytes += segment.coverage->shares.size();
    return bytes;
}

std::shared_ptr<const SegmentSet> SegmentSet::with(Segmentation added) const {
    auto joined = std::make_shared<SegmentSet>(*this);
    std::set<std::string> taken;
    for (const auto &place : m_places)
        taken.insert(place.first);
    for (std::size_t n = 0; n < added.segments.size(); ++n) {
        Segment &segment = added.segments[n];
        segment.name = system::uniqueName(segment.name, taken);
        joined->m_places[segment.name] = {m_segmentations.size(), n};
    }
    joined->m_segmentations.push_back(std::move(added));
    return joined;
}

} // namespace pellucid::segment
