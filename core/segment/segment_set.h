// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/segment/segmentation.h"

namespace pellucid::segment {

/// The segments that are loaded for a volume. Immutable: adding segments returns a new set.
class SegmentSet {
public:
    explicit SegmentSet(volume::Lattice lattice) : m_lattice(std::move(lattice)) {}

    /// The set with these segments, too. Names that are taken get a number: "liver (2)".
    std::shared_ptr<const SegmentSet> with(Segmentation added) const;

    /// The lattice of the volume.
    const volume::Lattice &lattice() const { return m_lattice; }
    /// In the order in which they were added, with their names in this set.
    const std::vector<Segmentation> &segmentations() const { return m_segmentations; }
    /// The segment of this name, or null.
    const Segment *find(const std::string &name) const;
    /// The file that the segment of this name comes from, or null.
    const Segmentation *fileOf(const std::string &name) const;
    std::size_t bytes() const;

private:
    struct Place {
        std::size_t segmentation = 0, segment = 0;
    };
    const Place *placeOf(const std::string &name) const;

    volume::Lattice m_lattice;
    std::vector<Segmentation> m_segmentations;
    std::map<std::string, Place> m_places; ///< by name
};

} // namespace pellucid::segment
