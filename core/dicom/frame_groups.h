// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/dicom/attribute_columns.h"
#include "core/dicom/stack_geometry.h"
#include "core/task/progress.h"

namespace pellucid::dicom {

/// Frames that make one volume, and what distinguishes them from the rest of their stack.
struct Part {
    std::vector<task::Reason> label;
    std::vector<PlacedFrame> frames;
    std::vector<task::Reason> warnings;
};

using FrameIndices = std::vector<std::size_t>; ///< of frames of a stack, sorted by depth

/// Frames that an attribute tells from others, and how.
struct FrameGroup {
    std::vector<task::Reason> label;
    FrameIndices frames;
};
using FrameGroups = std::vector<FrameGroup>;

/// The fewest slices that are split off as a volume of their own; fewer are stray images.
inline constexpr std::size_t minSlices = 3;

/// The frames of a stack and how their positions repeat. *Requires*: the frames and the progress
/// live longer. *Shape*: `frames` is sorted by depth and not empty.
class RepeatedFrames {
public:
    /// *Throws* Cancelled.
    RepeatedFrames(const std::vector<PlacedFrame> &frames, const task::Progress &progress);

    const FrameIndices &all() const { return m_all; }
    const PlacedFrame &operator[](std::size_t n) const { return m_frames[n]; }
    /// Throws Cancelled if asked to stop.
    void check() const { m_progress.check(); }

    /// The number of a frame's position, from 0 on without gaps.
    std::size_t positionOf(std::size_t n) const { return m_positionOf[n]; }
    std::size_t positions() const { return m_positionOf.back() + 1; }
    /// How often the most frequent position occurs.
    std::size_t mostRepeats() const { return m_mostRepeats; }
    bool repeats(const FrameIndices &sorted) const;
    /// How often each position occurs, if all occur equally often; else 0.
    std::size_t repeatsOfEach(const FrameIndices &sorted) const;
    bool isEvenStack(const FrameIndices &sorted) const;

    /// The groups of equal values, in the order of numbers, or else in that of first occurrence.
    /// *Throws* Cancelled.
    FrameGroups byValue(const FrameIndices &frames, const Column &column) const;

    std::vector<Part> partsOf(const FrameGroups &groups) const;

private:
    const std::vector<PlacedFrame> &m_frames;
    const task::Progress &m_progress;
    FrameIndices m_all;
    std::vector<std::size_t> m_positionOf; ///< by frame
    std::size_t m_mostRepeats = 0;
};

/// A group of another one, with the labels of both.
FrameGroup within(const FrameGroup &group, const FrameGroup &one);

} // namespace pellucid::dicom
