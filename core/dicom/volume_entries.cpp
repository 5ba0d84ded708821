// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/volume_entries.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/dicom/copies.h"
#include "core/dicom/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

VolumeEntry entryFrom(const Part &part) {
    VolumeEntry entry;
    entry.label = part.label;
    entry.notes.warnings = part.warnings;
    for (const PlacedFrame &frame : part.frames) {
        entry.frames.push_back(frame.reference);
        entry.frames.back().digest = digestOf(frame);
    }
    const auto shared = std::count_if(part.frames.begin(), part.frames.end(),
                                      [](const PlacedFrame &frame) { return frame.sharesUid; });
    if (shared > 0)
        entry.notes.warnings.push_back(because::sameInstanceUid(shared));
    return entry;
}

// Makes an entry of images without a common geometry: slices 1 mm apart, shown one by one.
void makeImages(VolumeEntry &entry, const std::vector<PlacedFrame> &frames,
                const task::Reason &reason) {
    entry.placed = false;
    entry.notPlacedReason = reason;
    const glm::dvec2 spacing = frames.front().header.spacingMm.value_or(glm::dvec2(1.0));
    entry.notes.hasSpacing = frames.front().header.spacingMm.has_value();
    entry.notes.hasDepth = false;
    entry.geometry = {
        volume::Lattice::centred({frames.front().columns, frames.front().rows, int(frames.size())},
                                 {spacing.x, spacing.y, 1.0}),
        {}};
}

VolumeEntry volumeOf(const Part &part, Slices slices = Slices::all) {
    VolumeEntry entry = entryFrom(part);
    StackResult stack = stackGeometry(part.frames, slices);
    if (stack.refusal)
        makeImages(entry, part.frames, *stack.refusal);
    else
        entry.geometry = std::move(stack.geometry);
    if (part.frames.size() == 1 && !(part.frames.front().header.sliceThicknessMm > 0.0))
        entry.notes.hasDepth = false;
    entry.notes.filled = std::move(stack.filled);
    entry.notes.warnings.insert(entry.notes.warnings.end(), stack.warnings.begin(),
                                stack.warnings.end());
    return entry;
}

// The volume of the frames [first, end) of a part, a run beside a break.
VolumeEntry runOf(const Part &part, std::size_t first, std::size_t end, const Break &at) {
    const bool isOne = end - first == 1;
    Part run{
        part.label,
        {part.frames.begin() + std::ptrdiff_t(first), part.frames.begin() + std::ptrdiff_t(end)},
        part.warnings};
    run.label.push_back(isOne ? because::slice(end) : because::slicesTo(first + 1, end));
    VolumeEntry entry = volumeOf(run);
    const std::string a = part.frames[at.at - 1].reference.path.filename().string(),
                      b = part.frames[at.at].reference.path.filename().string();
    const std::string gap = fmt::format("{:.1f}", at.gapMm);
    const std::size_t all = part.frames.size();
    entry.notes.warnings.push_back(
        at.shiftMm > 0.0 ? because::shiftBesideSlices(first + 1, end, all,
                                                      fmt::format("{:.1f}", at.shiftMm), a, b)
        : isOne          ? because::gapAroundSlice(end, all, gap, a, b)
                         : because::gapAroundSlices(first + 1, end, all, gap, a, b));
    return entry;
}

} // namespace

std::vector<VolumeEntry> volumesOf(const Part &part, Slices slices) {
    if (slices == Slices::arriving)
        return {volumeOf(part, slices)};
    const std::vector<Break> breaks = breaksOf(part.frames);
    if (breaks.empty())
        return {volumeOf(part)};
    std::vector<VolumeEntry> volumes;
    std::size_t first = 0;
    for (std::size_t n = 0; n <= breaks.size(); ++n) {
        const bool isLast = n == breaks.size();
        const std::size_t end = isLast ? part.frames.size() : breaks[n].at;
        volumes.push_back(runOf(part, first, end, breaks[isLast ? n - 1 : n]));
        first = end;
    }
    // Not if more slices would be interpolated than were scanned.
    VolumeEntry whole = volumeOf(part);
    if (!whole.placed || whole.geometry.lattice.size().k > 2 * int(part.frames.size()))
        return volumes;
    whole.fillsHoles = true;
    whole.label.emplace_back(because::gapsFilled);
    volumes.push_back(std::move(whole));
    return volumes;
}

VolumeEntry imagesOf(const Part &part, const task::Reason &reason) {
    VolumeEntry entry = entryFrom(part);
    makeImages(entry, part.frames, reason);
    return entry;
}

} // namespace pellucid::dicom
