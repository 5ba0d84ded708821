// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/frame_groups.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace because = task::because;

RepeatedFrames::RepeatedFrames(const std::vector<PlacedFrame> &frames,
                               const task::Progress &progress)
    : m_frames(frames), m_progress(progress), m_all(frames.size()), m_positionOf(frames.size()) {
    progress.check();
    std::iota(m_all.begin(), m_all.end(), std::size_t(0));
    for (std::size_t n = 1; n < frames.size(); ++n)
        m_positionOf[n] = m_positionOf[n - 1] + (sameDepth(frames[n - 1], frames[n]) ? 0 : 1);
    std::vector<std::size_t> repeats(positions());
    for (const std::size_t position : m_positionOf)
        m_mostRepeats = std::max(m_mostRepeats, ++repeats[position]);
}

bool RepeatedFrames::repeats(const FrameIndices &sorted) const {
    return std::adjacent_find(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
               return m_positionOf[a] == m_positionOf[b];
           }) != sorted.end();
}

std::size_t RepeatedFrames::repeatsOfEach(const FrameIndices &sorted) const {
    std::size_t places = 1;
    for (std::size_t n = 1; n < sorted.size(); ++n)
        places += m_positionOf[sorted[n - 1]] == m_positionOf[sorted[n]] ? 0 : 1;
    if (sorted.size() % places != 0)
        return 0;
    const std::size_t each = sorted.size() / places;
    for (std::size_t n = 0; n < sorted.size(); ++n)
        if (m_positionOf[sorted[n]] != m_positionOf[sorted[n - n % each]])
            return 0;
    return each;
}

bool RepeatedFrames::isEvenStack(const FrameIndices &sorted) const {
    if (sorted.size() < minSlices)
        return false;
    std::vector<PlacedFrame> frames;
    for (const std::size_t n : sorted)
        frames.push_back(m_frames[n]);
    const StackResult stack = stackGeometry(frames);
    return !stack.refusal && stack.warnings.empty();
}

FrameGroups RepeatedFrames::byValue(const FrameIndices &frames, const Column &column) const {
    std::map<std::uint32_t, std::size_t> known;
    FrameGroups groups;
    std::vector<std::optional<double>> numbers;
    for (const std::size_t n : frames) {
        m_progress.check();
        const std::uint32_t id = column.idOf(n);
        const auto [it, isNew] = known.try_emplace(id, groups.size());
        if (isNew) {
            groups.push_back({{id == 0 ? task::Reason(because::others) : column.labelOf(id)}, {}});
            numbers.push_back(column.numberOf(id));
        }
        groups[it->second].frames.push_back(n);
    }
    // Those without a value come first.
    std::vector<std::size_t> order(groups.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const bool areNumbers = std::all_of(order.begin(), order.end(), [&](std::size_t n) {
        return numbers[n] || column.idOf(groups[n].frames.front()) == 0;
    });
    if (areNumbers)
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    FrameGroups ordered;
    for (const std::size_t n : order)
        ordered.push_back(std::move(groups[n]));
    return ordered;
}

std::vector<Part> RepeatedFrames::partsOf(const FrameGroups &groups) const {
    std::vector<Part> parts;
    for (const FrameGroup &group : groups) {
        parts.push_back({group.label, {}, {}});
        for (const std::size_t n : group.frames)
            parts.back().frames.push_back(m_frames[n]);
    }
    return parts;
}

FrameGroup within(const FrameGroup &group, const FrameGroup &one) {
    FrameGroup both{group.label, one.frames};
    both.label.insert(both.label.end(), one.label.begin(), one.label.end());
    return both;
}

} // namespace pellucid::dicom
