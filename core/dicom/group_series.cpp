// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/group_series.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "core/dicom/copies.h"
#include "core/dicom/reasons.h"
#include "core/dicom/split_overlapping.h"
#include "core/dicom/split_repeats.h"
#include "core/dicom/volume_entries.h"
#include "core/volume/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using Frames = std::vector<PlacedFrame>;
// The volumes of each stack of slices.
using Stacks = std::vector<std::vector<VolumeEntry>>;

bool sameAxis(const glm::dvec3 &a, const glm::dvec3 &b) {
    return glm::distance(a, b) <= largestJitter;
}

bool sameSpacing(const glm::dvec2 &a, const glm::dvec2 &b) {
    const glm::dvec2 off = glm::abs(a / b - 1.0);
    return std::max(off.x, off.y) <= largestJitter;
}

bool sameBlock(const PlacedFrame &a, const PlacedFrame &b) {
    const FrameHeader &x = a.header, &y = b.header;
    return a.rows == b.rows && a.columns == b.columns && a.modality == b.modality &&
           isLocalizer(x) == isLocalizer(y) && a.statedValues == b.statedValues &&
           sameSpacing(*x.spacingMm, *y.spacingMm) && sameAxis(*x.rowAxis, *y.rowAxis) &&
           sameAxis(*x.columnAxis, *y.columnAxis);
}

// Groups frames that belong together. Each frame is compared only with blocks of about the same row
// axis, because a series may consist of many blocks.
std::vector<Frames>
blocksOf(const Frames &frames,
         const std::function<bool(const PlacedFrame &, const PlacedFrame &)> &same,
         const task::Progress &progress) {
    constexpr double cellsPerUnit =
        1.0 / (1.25 * largestJitter); // cells wider than the tolerance of `sameAxis`
    std::vector<Frames> blocks;
    std::map<std::tuple<int, int, long>, std::vector<std::size_t>> known;
    for (const PlacedFrame &frame : frames) {
        progress.check();
        const long cell =
            std::lround(cellsPerUnit * frame.header.rowAxis.value_or(glm::dvec3(0.0)).x);
        std::size_t found = blocks.size();
        for (long near = cell - 1; near <= cell + 1; ++near)
            if (const auto it = known.find({frame.rows, frame.columns, near}); it != known.end())
                for (const std::size_t n : it->second)
                    if (n < found && same(blocks[n].front(), frame))
                        found = n;
        if (found == blocks.size()) {
            blocks.emplace_back();
            known[{frame.rows, frame.columns, cell}].push_back(found);
        }
        blocks[found].push_back(frame);
    }
    return blocks;
}

// Splits a block by frame of reference. Some anonymisers give each image a different UID: if hardly
// any repeats, the UIDs carry no information.
std::vector<Frames> spacesOf(Frames block, std::vector<task::Reason> &warnings) {
    constexpr std::size_t minSpaces = 3;
    std::map<std::string, std::size_t> known;
    std::vector<Frames> spaces;
    for (PlacedFrame &frame : block) {
        const auto [it, isNew] = known.try_emplace(frame.frameOfReferenceUid, spaces.size());
        if (isNew)
            spaces.emplace_back();
        spaces[it->second].push_back(frame);
    }
    const auto alone = std::size_t(std::count_if(
        spaces.begin(), spaces.end(), [](const Frames &space) { return space.size() == 1; }));
    if (spaces.size() < minSpaces || 10 * alone < 9 * block.size())
        return spaces;
    warnings.emplace_back(because::framesOfReferenceDiffer);
    return {std::move(block)};
}

// The name of a stack, and the name of one of several of that direction.
struct Direction {
    task::Because<0> name;
    task::Because<1> numbered;
};

// The anatomical plane that is closest to a stack's slices.
Direction directionOf(const VolumeEntry &entry) {
    if (!entry.placed)
        return {because::images, because::imagesNumber};
    const glm::dvec3 normal =
        glm::abs(glm::cross(entry.geometry.lattice.step(0), entry.geometry.lattice.step(1)));
    if (normal.z >= normal.x && normal.z >= normal.y)
        return {because::axial, because::axialNumber};
    return normal.y >= normal.x ? Direction{because::coronal, because::coronalNumber}
                                : Direction{because::sagittal, because::sagittalNumber};
}

// If there are several stacks, such as the three of a localizer, labels each with its direction.
// Phases of one stack have the same label.
void nameStacks(Stacks &stacks) {
    if (stacks.size() < 2)
        return;
    std::map<std::string_view, int> count, number;
    for (const auto &stack : stacks)
        ++count[directionOf(stack.front()).name.sentence.name];
    for (auto &stack : stacks) {
        const Direction direction = directionOf(stack.front());
        const std::string_view id = direction.name.sentence.name;
        const task::Reason name =
            count[id] > 1 ? direction.numbered(++number[id]) : task::Reason(direction.name);
        for (VolumeEntry &entry : stack)
            entry.label.push_back(name);
    }
}

std::optional<task::Reason> missingGeometry(const FrameHeader &h) {
    if (!h.positionMm)
        return because::noPosition;
    if (!h.rowAxis)
        return because::noOrientation;
    if (!h.spacingMm)
        return because::noPixelSpacing;
    return std::nullopt;
}

Frames framesOf(const std::vector<SeriesFile> &files) {
    Frames frames;
    for (const SeriesFile &file : files)
        for (int n = 0; n < int(file.header.frames.size()); ++n) {
            // Not one aggregate: if a copy fails for lack of memory, GCC 12 destroys the members of
            // an inner aggregate twice.
            PlacedFrame frame;
            frame.reference = {file.path, n};
            frame.header = file.header.frames[std::size_t(n)];
            frame.rows = file.header.rows;
            frame.columns = file.header.columns;
            frame.instanceNumber = file.header.instanceNumber;
            frame.framesOfFile = int(file.header.frames.size());
            frame.sopInstanceUid = file.header.sopInstanceUid;
            frame.frameOfReferenceUid = file.header.frameOfReferenceUid;
            frame.modality = file.header.modality;
            frame.statedValues = statedValues(file.header, n);
            frames.push_back(std::move(frame));
        }
    return frames;
}

// Adds a set of images.
void addImages(Frames frames, const task::Reason &reason, Stacks &stacks) {
    std::stable_sort(frames.begin(), frames.end(), [](const PlacedFrame &a, const PlacedFrame &b) {
        return std::tuple(a.instanceNumber, a.reference.frame) <
               std::tuple(b.instanceNumber, b.reference.frame);
    });
    stacks.emplace_back().push_back(imagesOf({{}, std::move(frames), {}}, reason));
}

// Whether the parts are packages of one stack, such as its odd and its even slices: together they
// fill it.
bool arePackages(const StackResult &whole, const std::vector<Part> &parts) {
    if (whole.refusal)
        return false;
    const double stepMm = stackGeometry(parts.front().frames).geometry.lattice.sliceDistanceMm(),
                 together = double(parts.size()) * whole.geometry.lattice.sliceDistanceMm();
    return std::abs(together - stepMm) < 0.1 * stepMm;
}

// Whether slices are clearly thicker than they are apart.
bool areOverlapping(const Frames &block, const StackResult &whole) {
    const double apartMm = whole.geometry.lattice.sliceDistanceMm();
    return std::all_of(block.begin(), block.end(), [&](const PlacedFrame &frame) {
        return frame.header.sliceThicknessMm > 1.5 * apartMm;
    });
}

// Whether no slices of one part overlap: what an acquisition leaves out, no other one fills by
// chance.
bool areAsThickAsApart(const std::vector<Part> &parts) {
    return std::all_of(parts.begin(), parts.end(), [](const Part &part) {
        const double apartMm = stackGeometry(part.frames).geometry.lattice.sliceDistanceMm();
        return std::all_of(part.frames.begin(), part.frames.end(), [&](const PlacedFrame &frame) {
            return std::abs(frame.header.sliceThicknessMm - apartMm) < 0.1 * apartMm;
        });
    });
}

// The parts of a block that are a volume each. Empty if repeated images cannot be told apart.
std::vector<Part> partsOf(const Frames &block, Slices slices, const ReadAttributes &read,
                          const task::Progress &progress) {
    if (slices == Slices::remaining)
        return {{{}, block, {}}};
    if (hasRepeatedPositions(block))
        return splitRepeats(block, read, progress);
    if (slices == Slices::all && block.size() > 1) {
        const StackResult whole = stackGeometry(block);
        const auto isUneven = [](const task::Reason &warning) {
            return warning.is(because::unevenSlices) || warning.is(because::missingSlices);
        };
        if (whole.refusal || std::any_of(whole.warnings.begin(), whole.warnings.end(), isUneven))
            if (std::vector<Part> parts = splitOverlapping(block, read, progress);
                !parts.empty() && !arePackages(whole, parts))
                return parts;
        // Scans that lie halfway between each other are even together, too, but each of their
        // slices is as thick as its own scan's are apart.
        if (!whole.refusal && whole.warnings.empty() && areOverlapping(block, whole))
            if (std::vector<Part> parts = splitOverlapping(block, nullptr, progress);
                !parts.empty() && areAsThickAsApart(parts))
                return parts;
    }
    return {{{}, block, {}}};
}

// Adds the stacks of frames whose geometry is known.
void addVolumes(const Frames &frames, Slices slices, const ReadAttributes &read,
                const task::Progress &progress, Stacks &stacks) {
    for (const Frames &images : blocksOf(frames, sameBlock, progress)) {
        std::vector<task::Reason> warnings;
        for (Frames &block : spacesOf(images, warnings)) {
            sortByDepth(block);
            const std::vector<Part> parts = partsOf(block, slices, read, progress);
            if (parts.empty())
                addImages(block, because::imagesCannotBeToldApart, stacks);
            // The phases of a run of slices share one stack.
            std::map<std::pair<std::size_t, bool>, std::size_t> runs;
            for (const Part &part : parts) {
                progress.check();
                std::vector<VolumeEntry> volumes = volumesOf(part, slices);
                for (std::size_t n = 0; n < volumes.size(); ++n) {
                    VolumeEntry &entry = volumes[n];
                    entry.notes.warnings.insert(entry.notes.warnings.begin(), warnings.begin(),
                                                warnings.end());
                    const auto [it, isNew] = runs.try_emplace(
                        {entry.fillsHoles ? 0 : n, entry.fillsHoles}, stacks.size());
                    if (isNew)
                        stacks.emplace_back();
                    stacks[it->second].push_back(std::move(entry));
                }
            }
        }
    }
}

// Adds the frames without geometry as sets of images.
void addUnplaced(const Frames &frames, const task::Progress &progress, Stacks &stacks) {
    const auto sameSize = [](const PlacedFrame &a, const PlacedFrame &b) {
        return a.rows == b.rows && a.columns == b.columns &&
               missingGeometry(a.header) == missingGeometry(b.header);
    };
    for (const Frames &block : blocksOf(frames, sameSize, progress))
        addImages(block, *missingGeometry(block.front().header), stacks);
}

} // namespace

bool isLocalizer(const FrameHeader &frame) {
    return frame.imageType().find("LOCALIZER") != std::string::npos;
}

int statedValues(const InstanceHeader &header, int frame) {
    const decoding::Rescale &rescale = header.frames.at(std::size_t(frame)).rescale;
    return header.modalityTable.empty()
               ? int(rescale.isSlopeStated) + int(rescale.isInterceptStated)
               : 2;
}

std::vector<VolumeEntry> groupSeries(const std::vector<SeriesFile> &files,
                                     std::vector<Skipped> &skipped, const task::Progress &progress,
                                     Slices slices, const ReadAttributes &read) {
    Frames placed, unplaced;
    for (PlacedFrame &frame : framesOf(files))
        (missingGeometry(frame.header) ? unplaced : placed).push_back(std::move(frame));
    dropCopies(placed, skipped);
    dropCopies(unplaced, skipped);
    Stacks stacks;
    addVolumes(placed, slices, read, progress, stacks);
    addUnplaced(unplaced, progress, stacks);
    nameStacks(stacks);
    std::vector<VolumeEntry> entries;
    for (auto &stack : stacks)
        std::move(stack.begin(), stack.end(), std::back_inserter(entries));
    return entries;
}

} // namespace pellucid::dicom
