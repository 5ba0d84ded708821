// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/segment/segmentation.h"

namespace pellucid::segment {

/// The segments that are loaded for a volume. Immutable; a set with more segments is another one.
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
    bool isEmpty() const { return m_segmentations.empty(); }
    /// The title of the file that a segment comes from; empty if there is no such segment.
    std::string titleOf(const std::string &name) const;
    std::size_t bytes() const;

private:
    volume::Lattice m_lattice;
    std::vector<Segmentation> m_segmentations;
};

} // namespace pellucid::segment
