// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_repeats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using Frames = std::vector<PlacedFrame>;

bool samePosition(const PlacedFrame &a, const PlacedFrame &b) {
    return std::abs(a.depthMm - b.depthMm) < 0.01;
}

// An attribute that can distinguish volumes at the same positions.
struct Attribute {
    task::Because<1> label;
    std::function<std::string(const PlacedFrame &)> valueOf;
};

// Attributes of the header, named as in `FrameHeader::dimensions`.
constexpr std::array<std::pair<const char *, task::Because<1>>, 8> dimensions{{
    {"temporal position", because::temporalPosition},
    {"echo", because::echo},
    {"b-value", because::bValue},
    {"trigger time", because::triggerTime},
    {"stack", because::stack},
    {"acquisition", because::acquisition},
    {"acquisition time", because::acquisitionTime},
    {"content time", because::contentTime},
}};

// The attributes in the order in which they are tried.
std::vector<Attribute> attributesByPriority() {
    std::vector<Attribute> attributes;
    for (const auto &[name, label] : dimensions)
        attributes.push_back({label, [name = name](const PlacedFrame &frame) {
                                  const auto it = frame.header.dimensions.find(name);
                                  return it == frame.header.dimensions.end() ? std::string()
                                                                             : it->second;
                              }});
    attributes.push_back({because::type, [](const PlacedFrame &f) { return f.header.imageType; }});
    attributes.push_back({because::fileNamed, [](const PlacedFrame &f) {
                              return f.reference.path.filename().string();
                          }});
    return attributes;
}

// Splits by a value that every frame has, in the order of first occurrence.
std::vector<Part> splitBy(const Frames &sorted, const Attribute &attribute,
                          const task::Progress &progress) {
    std::vector<Part> parts;
    std::map<std::string, std::size_t> known;
    for (const PlacedFrame &frame : sorted) {
        progress.check();
        const auto [it, isNew] = known.try_emplace(attribute.valueOf(frame), parts.size());
        if (isNew)
            parts.push_back({{attribute.label(it->first)}, {}});
        parts[it->second].frames.push_back(frame);
    }
    return parts;
}

// A split is right if every part has each position exactly once.
bool separates(const std::vector<Part> &parts, std::size_t places) {
    return parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const Part &part) {
               return part.frames.size() == places && !hasRepeatedPositions(part.frames);
           });
}

// Good enough if slices are missing: no position twice, and no very small part.
bool nearlySeparates(const std::vector<Part> &parts, std::size_t places) {
    return parts.size() > 1 && std::all_of(parts.begin(), parts.end(), [&](const Part &part) {
               return 2 * part.frames.size() > places && !hasRepeatedPositions(part.frames);
           });
}

// If no attribute distinguishes them: the first image of every position, then the second, ...
std::vector<Part> splitByNumber(const Frames &sorted, const task::Progress &progress) {
    std::vector<Part> parts;
    for (auto place = sorted.begin(); place != sorted.end();) {
        progress.check();
        const auto last = std::adjacent_find(
            place, sorted.end(), [](const auto &a, const auto &b) { return !samePosition(a, b); });
        Frames here(place, last == sorted.end() ? last : last + 1);
        place += std::ptrdiff_t(here.size());
        std::stable_sort(here.begin(), here.end(), [](const PlacedFrame &a, const PlacedFrame &b) {
            return a.instanceNumber < b.instanceNumber;
        });
        for (std::size_t n = 0; n < here.size(); ++n) {
            if (n == parts.size())
                parts.push_back({{because::set(n + 1)}, {}});
            parts[n].frames.push_back(here[n]);
        }
    }
    for (Part &part : parts)
        sortByDepth(part.frames);
    return parts;
}

} // namespace

bool hasRepeatedPositions(const Frames &sorted) {
    return std::adjacent_find(sorted.begin(), sorted.end(), samePosition) != sorted.end();
}

std::vector<Part> splitRepeats(const Frames &sorted, const task::Progress &progress) {
    std::size_t places = 1;
    for (std::size_t n = 1; n < sorted.size(); ++n)
        places += samePosition(sorted[n - 1], sorted[n]) ? 0 : 1;
    std::vector<Part> uneven;
    for (const Attribute &attribute : attributesByPriority()) {
        std::vector<Part> parts = splitBy(sorted, attribute, progress);
        if (separates(parts, places))
            return parts;
        if (uneven.empty() && nearlySeparates(parts, places))
            uneven = std::move(parts);
    }
    return !uneven.empty() ? uneven : splitByNumber(sorted, progress);
}

} // namespace pellucid::dicom
