// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/group_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace pellucid::dicom {

namespace {

using Frames = std::vector<PlacedFrame>;

// Axes written with six digits differ by rounding; 1e-4 is 0.006 degrees, a tenth of a voxel across
// a large image.
bool sameAxis(const glm::dvec3 &a, const glm::dvec3 &b) {
    return glm::distance(a, b) < 1e-4;
}

bool isLocalizer(const std::string &imageType) {
    return imageType.find("LOCALIZER") != std::string::npos;
}

bool sameBlock(const PlacedFrame &a, const PlacedFrame &b) {
    const FrameHeader &x = a.header, &y = b.header;
    return a.rows == b.rows && a.columns == b.columns &&
           isLocalizer(x.imageType) == isLocalizer(y.imageType) &&
           glm::distance(*x.spacingMm, *y.spacingMm) < 1e-4 && sameAxis(*x.rowAxis, *y.rowAxis) &&
           sameAxis(*x.columnAxis, *y.columnAxis);
}

bool samePlace(const PlacedFrame &a, const PlacedFrame &b) {
    return std::abs(a.depthMm - b.depthMm) < 0.01;
}

bool placesRepeat(const Frames &sorted) {
    return std::adjacent_find(sorted.begin(), sorted.end(), samePlace) != sorted.end();
}

// One instance twice, as when a CD is copied into a folder that has it already.
void dropCopies(Frames &frames, std::vector<Skipped> &skipped) {
    std::map<std::pair<std::string, int>, std::filesystem::path> seen;
    std::vector<std::filesystem::path> reported;
    std::erase_if(frames, [&](const PlacedFrame &frame) {
        if (frame.sopInstanceUid.empty())
            return false;
        const auto [it, fresh] =
            seen.try_emplace({frame.sopInstanceUid, frame.reference.frame}, frame.reference.path);
        if (fresh)
            return false;
        if (std::find(reported.begin(), reported.end(), frame.reference.path) == reported.end()) {
            skipped.push_back({frame.reference.path,
                               "has the instance UID of " + it->second.filename().string()});
            reported.push_back(frame.reference.path);
        }
        return true;
    });
}

struct Part {
    std::string label;
    Frames frames;
};

std::vector<Part> splitBy(const Frames &sorted, const std::string &name,
                          const std::function<std::string(const PlacedFrame &)> &key) {
    std::vector<Part> parts;
    for (const PlacedFrame &frame : sorted) {
        const std::string label = fmt::format("{} {}", name, key(frame));
        auto it = std::find_if(parts.begin(), parts.end(),
                               [&](const Part &p) { return p.label == label; });
        if (it == parts.end())
            it = parts.insert(parts.end(), {label, {}});
        it->frames.push_back(frame);
    }
    return parts;
}

// A split is right if every part has each place exactly once.
bool separates(const std::vector<Part> &parts, std::size_t places) {
    return parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const Part &part) {
               return part.frames.size() == places && !placesRepeat(part.frames);
           });
}

// Good enough where slices are missing: no place twice, and no part a splinter.
bool separatesUnevenly(const std::vector<Part> &parts, std::size_t places) {
    return parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const Part &part) {
               return 2 * part.frames.size() > places && !placesRepeat(part.frames);
           });
}

std::vector<Part> splitRepeats(const Frames &sorted) {
    std::size_t places = 1;
    for (std::size_t n = 1; n < sorted.size(); ++n)
        places += samePlace(sorted[n - 1], sorted[n]) ? 0 : 1;
    std::vector<std::vector<Part>> splits;
    for (const char *name : {"temporal position", "echo", "b-value", "trigger time", "stack",
                             "acquisition", "acquisition time", "content time"})
        splits.push_back(splitBy(sorted, name, [name](const PlacedFrame &frame) {
            const auto it = frame.header.dimensions.find(name);
            return it == frame.header.dimensions.end() ? std::string() : it->second;
        }));
    splits.push_back(
        splitBy(sorted, "type", [](const PlacedFrame &f) { return f.header.imageType; }));
    splits.push_back(splitBy(
        sorted, "file", [](const PlacedFrame &f) { return f.reference.path.filename().string(); }));
    for (const auto &parts : splits)
        if (separates(parts, places))
            return parts;
    for (const auto &parts : splits)
        if (separatesUnevenly(parts, places))
            return parts;
    // Nothing in the headers tells them apart: the first image of every place, then the second, ...
    Frames byNumber = sorted;
    std::stable_sort(byNumber.begin(), byNumber.end(),
                     [](const PlacedFrame &a, const PlacedFrame &b) {
                         return a.instanceNumber < b.instanceNumber;
                     });
    std::vector<Part> parts;
    for (const PlacedFrame &frame : byNumber) {
        auto it = std::find_if(parts.begin(), parts.end(), [&](const Part &part) {
            return std::none_of(part.frames.begin(), part.frames.end(),
                                [&](const PlacedFrame &other) { return samePlace(frame, other); });
        });
        if (it == parts.end())
            it = parts.insert(parts.end(), {fmt::format("set {}", parts.size() + 1), {}});
        it->frames.push_back(frame);
    }
    for (Part &part : parts)
        sortByDepth(part.frames);
    return parts;
}

VolumeEntry entryFrom(const Part &part) {
    VolumeEntry entry;
    entry.label = part.label;
    for (const PlacedFrame &frame : part.frames)
        entry.frames.push_back(frame.reference);
    return entry;
}

// Images without a common geometry: a pile one sample thick each, shown one by one.
void makeImages(VolumeEntry &entry, const Frames &frames, const std::string &reason) {
    entry.placed = false;
    entry.notPlacedReason = reason;
    const glm::dvec2 spacing = frames.front().header.spacingMm.value_or(glm::dvec2(1.0));
    entry.notes.hasSpacing = frames.front().header.spacingMm.has_value();
    entry.geometry = {
        volume::Lattice::centred({frames.front().columns, frames.front().rows, int(frames.size())},
                                 {spacing.x, spacing.y, 1.0}),
        {}};
}

std::vector<Frames>
blocksOf(const Frames &frames,
         const std::function<bool(const PlacedFrame &, const PlacedFrame &)> &same) {
    std::vector<Frames> blocks;
    for (const PlacedFrame &frame : frames) {
        auto it = std::find_if(blocks.begin(), blocks.end(),
                               [&](const Frames &b) { return same(b.front(), frame); });
        if (it == blocks.end())
            it = blocks.insert(blocks.end(), Frames());
        it->push_back(frame);
    }
    return blocks;
}

// The side of the body that a stack's slices are seen from: the nearest.
std::string orientationName(const VolumeEntry &entry) {
    if (!entry.placed)
        return "images";
    const glm::dvec3 normal =
        glm::abs(glm::cross(entry.geometry.lattice.step(0), entry.geometry.lattice.step(1)));
    return normal.z >= normal.x && normal.z >= normal.y ? "axial"
           : normal.y >= normal.x                       ? "coronal"
                                                        : "sagittal";
}

// Stacks that nothing has told apart yet: the three of a localizer, slices of different angles.
void tellApart(std::vector<VolumeEntry> &entries) {
    const auto labelAlike = [&](const auto &label) {
        std::map<std::string, std::vector<VolumeEntry *>> alike;
        for (VolumeEntry &entry : entries)
            alike[entry.label].push_back(&entry);
        for (auto &[former, same] : alike)
            for (std::size_t n = 0; same.size() > 1 && n < same.size(); ++n)
                same[n]->label = label(*same[n], n + 1);
    };
    labelAlike([](const VolumeEntry &entry, std::size_t) {
        const std::string name = orientationName(entry);
        return entry.label.empty() ? name : entry.label + ", " + name;
    });
    labelAlike([](const VolumeEntry &entry, std::size_t number) {
        return fmt::format("{} {}", entry.label, number);
    });
}

std::string missingGeometry(const FrameHeader &h) {
    if (!h.positionMm)
        return "the images have no position";
    if (!h.rowAxis)
        return "the images have no orientation";
    if (!h.spacingMm)
        return "the images have no pixel spacing";
    return {};
}

} // namespace

std::vector<VolumeEntry> groupSeries(const std::vector<SeriesFile> &files,
                                     std::vector<Skipped> &skipped) {
    Frames placed, unplaced;
    for (const SeriesFile &file : files)
        for (int n = 0; n < int(file.header.frames.size()); ++n) {
            PlacedFrame frame{
                {file.path, n},      file.header.frames[n],      file.header.rows,
                file.header.columns, file.header.instanceNumber, file.header.sopInstanceUid};
            (missingGeometry(frame.header).empty() ? placed : unplaced).push_back(std::move(frame));
        }
    dropCopies(placed, skipped);
    dropCopies(unplaced, skipped);

    std::vector<VolumeEntry> entries;
    for (Frames &block : blocksOf(placed, sameBlock)) {
        sortByDepth(block);
        const std::vector<Part> parts =
            placesRepeat(block) ? splitRepeats(block) : std::vector<Part>{{"", block}};
        for (const Part &part : parts) {
            VolumeEntry entry = entryFrom(part);
            StackResult stack = stackGeometry(part.frames);
            if (stack.refusal.empty())
                entry.geometry = std::move(stack.geometry);
            else
                makeImages(entry, part.frames, stack.refusal);
            entry.notes.warnings = std::move(stack.warnings);
            entries.push_back(std::move(entry));
        }
    }
    const auto sameSize = [](const PlacedFrame &a, const PlacedFrame &b) {
        return a.rows == b.rows && a.columns == b.columns &&
               missingGeometry(a.header) == missingGeometry(b.header);
    };
    for (Frames &block : blocksOf(unplaced, sameSize)) {
        std::stable_sort(block.begin(), block.end(),
                         [](const PlacedFrame &a, const PlacedFrame &b) {
                             return std::tuple(a.instanceNumber, a.reference.frame) <
                                    std::tuple(b.instanceNumber, b.reference.frame);
                         });
        VolumeEntry entry = entryFrom({"", block});
        makeImages(entry, block, missingGeometry(block.front().header));
        entries.push_back(std::move(entry));
    }
    tellApart(entries);
    return entries;
}

} // namespace pellucid::dicom
