// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_repeats.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace pellucid::dicom {

namespace {

namespace because = task::because;
using Frames = std::vector<PlacedFrame>;
using Indices = std::vector<std::size_t>; ///< of frames, sorted by depth

bool samePosition(const PlacedFrame &a, const PlacedFrame &b) {
    return std::abs(a.depthMm - b.depthMm) < 0.01;
}

// Frames that an attribute tells from others, and how.
struct Group {
    std::vector<task::Reason> label;
    Indices frames;
};
using Groups = std::vector<Group>;

// What a smaller volume must have to be one, and not a few stray slices.
constexpr std::size_t minSlices = 3;

class Splitter {
public:
    Splitter(const Frames &frames, const task::Progress &progress)
        : m_frames(frames), m_progress(progress), m_all(frames.size()), m_placeOf(frames.size()) {
        progress.check();
        std::iota(m_all.begin(), m_all.end(), std::size_t(0));
        for (std::size_t n = 1; n < frames.size(); ++n)
            m_placeOf[n] = m_placeOf[n - 1] + (samePosition(frames[n - 1], frames[n]) ? 0 : 1);
        std::vector<std::size_t> repeats(m_placeOf.back() + 1);
        for (const std::size_t place : m_placeOf)
            m_mostRepeats = std::max(m_mostRepeats, ++repeats[place]);
    }

    // The groups by these attributes; empty if they do not separate the frames.
    Groups split(const std::vector<Column> &columns) const {
        if (Groups groups = splitExactly(m_all, columns); !groups.empty())
            return groups;
        // Where slices are missing: as many groups as repeats, or groups that are each a stack.
        if (Groups groups = refined(columns); !groups.empty())
            return groups;
        for (const Column &column : columns) {
            Groups groups = byValue(m_all, column);
            if (groups.size() > 1 &&
                std::all_of(groups.begin(), groups.end(), [&](const Group &group) {
                    return !repeats(group.frames) && isEvenStack(group.frames);
                }))
                return groups;
        }
        return {};
    }

    // The same of frames whose positions do not repeat.
    Groups splitOverlapping(const std::vector<Column> &columns) const {
        for (const Column &column : columns) {
            Groups groups = byValue(m_all, column);
            const auto isStack = [&](const Group &group) { return isEvenStack(group.frames); };
            if (groups.size() > 1 && std::all_of(groups.begin(), groups.end(), isStack) &&
                overlap(groups))
                return groups;
        }
        return {};
    }

    // By image numbers that run part by part, or position by position. Empty if they do neither.
    Groups splitByNumber() const {
        Indices byNumber = m_all;
        const auto number = [&](std::size_t n) {
            return std::tuple(m_frames[n].instanceNumber, m_frames[n].reference.frame);
        };
        std::stable_sort(byNumber.begin(), byNumber.end(),
                         [&](std::size_t a, std::size_t b) { return number(a) < number(b); });
        std::vector<std::size_t> met(m_placeOf.back() + 1), setOf(m_frames.size());
        bool runsByPart = true, runsByPlace = true;
        std::size_t set = 0;
        for (std::size_t n = 0; n < byNumber.size(); ++n) {
            const std::size_t frame = byNumber[n], place = m_placeOf[frame];
            if (n > 0) {
                if (number(byNumber[n - 1]) == number(frame))
                    return {};
                const bool isSamePlace = m_placeOf[byNumber[n - 1]] == place;
                runsByPlace = runsByPlace && (isSamePlace || met[place] == 0);
            }
            // A set ends where a position comes again.
            runsByPart = runsByPart && met[place] + 1 >= set;
            setOf[frame] = met[place]++;
            set = std::max(set, met[place]);
        }
        // Without one image, those of its position would count for another set.
        const bool isWhole = repeatsOfEach(m_all) == m_mostRepeats;
        if (!runsByPart && !(runsByPlace && isWhole))
            return {};
        Groups groups(m_mostRepeats);
        for (const std::size_t frame : m_all)
            groups[setOf[frame]].frames.push_back(frame);
        for (std::size_t n = 0; n < groups.size(); ++n)
            groups[n].label = {because::set(n + 1)};
        return groups;
    }

    std::vector<Part> partsOf(const Groups &groups) const {
        std::vector<Part> parts;
        for (const Group &group : groups) {
            parts.push_back({group.label, {}, {}});
            for (const std::size_t n : group.frames)
                parts.back().frames.push_back(m_frames[n]);
        }
        return parts;
    }

private:
    // By as many attributes as it takes until no position repeats in a group. Empty if that makes
    // more groups than there are repeats.
    Groups refined(const std::vector<Column> &columns) const {
        Groups groups{{{}, m_all}};
        for (const Column &column : columns) {
            Groups finer;
            for (const Group &group : groups) {
                if (!repeats(group.frames)) {
                    finer.push_back(group);
                    continue;
                }
                for (const Group &one : byValue(group.frames, column))
                    finer.push_back(within(group, one));
            }
            if (finer.size() > groups.size() && finer.size() <= m_mostRepeats)
                groups = std::move(finer);
        }
        const bool isSplit = groups.size() == m_mostRepeats &&
                             std::none_of(groups.begin(), groups.end(), [&](const Group &group) {
                                 return repeats(group.frames);
                             });
        return isSplit ? groups : Groups();
    }

    // The labels of both.
    static Group within(const Group &group, const Group &one) {
        Group both{group.label, one.frames};
        both.label.insert(both.label.end(), one.label.begin(), one.label.end());
        return both;
    }

    bool repeats(const Indices &sorted) const {
        return std::adjacent_find(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
                   return m_placeOf[a] == m_placeOf[b];
               }) != sorted.end();
    }

    std::size_t placesIn(const Indices &sorted) const {
        std::size_t places = 1;
        for (std::size_t n = 1; n < sorted.size(); ++n)
            places += m_placeOf[sorted[n - 1]] == m_placeOf[sorted[n]] ? 0 : 1;
        return places;
    }

    // How often each position occurs, if all occur equally often; else 0.
    std::size_t repeatsOfEach(const Indices &sorted) const {
        const std::size_t places = placesIn(sorted);
        if (sorted.size() % places != 0)
            return 0;
        const std::size_t each = sorted.size() / places;
        for (std::size_t n = 0; n < sorted.size(); ++n)
            if (m_placeOf[sorted[n]] != m_placeOf[sorted[n - n % each]])
                return 0;
        return each;
    }

    bool isEvenStack(const Indices &sorted) const {
        if (sorted.size() < minSlices)
            return false;
        Frames frames;
        for (const std::size_t n : sorted)
            frames.push_back(m_frames[n]);
        const StackResult stack = stackGeometry(frames);
        return !stack.refusal && stack.warnings.empty();
    }

    // Whether each pair shares at least half of the shorter one's extent.
    bool overlap(const Groups &groups) const {
        const auto first = [&](const Group &g) { return m_frames[g.frames.front()].depthMm; };
        const auto last = [&](const Group &g) { return m_frames[g.frames.back()].depthMm; };
        for (const Group &a : groups)
            for (const Group &b : groups) {
                const double shared = std::min(last(a), last(b)) - std::max(first(a), first(b));
                if (shared < 0.5 * std::min(last(a) - first(a), last(b) - first(b)))
                    return false;
            }
        return true;
    }

    // In the order of numbers, or else in that of first occurrence.
    Groups byValue(const Indices &frames, const Column &column) const {
        std::map<std::uint32_t, std::size_t> known;
        Groups groups;
        std::vector<std::optional<double>> numbers;
        for (const std::size_t n : frames) {
            m_progress.check();
            const std::uint32_t id = column.idOf(n);
            const auto [it, isNew] = known.try_emplace(id, groups.size());
            if (isNew) {
                groups.push_back(
                    {{id == 0 ? task::Reason(because::others) : column.labelOf(id)}, {}});
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
        Groups ordered;
        for (const std::size_t n : order)
            ordered.push_back(std::move(groups[n]));
        return ordered;
    }

    // By the order of the values at each position. Empty if it means nothing: from one position to
    // the next the values of a part must keep closer together than those of different parts, apart
    // from a drift that all have in common.
    Groups byRank(const Indices &frames, const Column &column, std::size_t each) const {
        const std::size_t places = frames.size() / each;
        // Noise follows itself by chance: in a few positions, or among many attributes.
        constexpr std::size_t manyPairs = 12;
        const std::size_t pairs = (places - 1) * (each - 1);
        if (!column.mayDrift() || places < minSlices || (!column.isKnown() && pairs < manyPairs))
            return {};
        const double tolerance = column.isKnown() ? 0.5 : 0.25; // of the narrowest gap
        std::vector<double> before, here(each);
        Groups groups(each);
        for (std::size_t place = 0; place < places; ++place) {
            m_progress.check();
            Indices at(frames.begin() + std::ptrdiff_t(place * each),
                       frames.begin() + std::ptrdiff_t((place + 1) * each));
            const auto value = [&](std::size_t n) { return column.numberOf(column.idOf(n)); };
            if (std::any_of(at.begin(), at.end(), [&](std::size_t n) { return !value(n); }))
                return {};
            std::sort(at.begin(), at.end(),
                      [&](std::size_t a, std::size_t b) { return *value(a) < *value(b); });
            for (std::size_t n = 0; n < each; ++n) {
                here[n] = *value(at[n]);
                groups[n].frames.push_back(at[n]);
            }
            if (!before.empty() && !follows(before, here, tolerance))
                return {};
            before = here;
        }
        for (Group &group : groups)
            group.label = {column.labelOf(column.idOf(group.frames[group.frames.size() / 2]))};
        return groups;
    }

    static double narrowestGap(const std::vector<double> &sorted) {
        double gap = std::numeric_limits<double>::infinity();
        for (std::size_t n = 1; n < sorted.size(); ++n)
            gap = std::min(gap, sorted[n] - sorted[n - 1]);
        return gap;
    }

    static bool follows(const std::vector<double> &before, const std::vector<double> &here,
                        double tolerance) {
        double drift = 0.0;
        for (std::size_t n = 0; n < here.size(); ++n)
            drift += (here[n] - before[n]) / double(here.size());
        const double most = tolerance * std::min(narrowestGap(before), narrowestGap(here));
        for (std::size_t n = 0; n < here.size(); ++n)
            if (!(std::abs(here[n] - before[n] - drift) < most))
                return false;
        return true;
    }

    // So that each group has each position of the frames once. Empty if there is no such split.
    Groups splitExactly(const Indices &frames, const std::vector<Column> &columns) const {
        const std::size_t each = repeatsOfEach(frames);
        // Attributes that a file makes up could be combined for ever.
        constexpr int mostCombinations = 10000;
        if (each < 2 || ++m_combinations > mostCombinations)
            return {};
        const std::size_t places = frames.size() / each;
        for (const Column &column : columns) {
            Groups groups = byValue(frames, column);
            if (groups.size() < 2)
                continue;
            const bool isUniform =
                std::all_of(groups.begin(), groups.end(), [&](const Group &group) {
                    const std::size_t ofGroup = repeatsOfEach(group.frames);
                    return ofGroup > 0 && ofGroup * places == group.frames.size();
                });
            if (isUniform) {
                if (auto all = splitFurther(groups, places, columns))
                    return std::move(*all);
            } else if (Groups ranked = byRank(frames, column, each); !ranked.empty()) {
                return ranked;
            }
        }
        return {};
    }

    // Splits those that still repeat by further attributes.
    std::optional<Groups> splitFurther(const Groups &groups, std::size_t places,
                                       const std::vector<Column> &columns) const {
        Groups all;
        for (const Group &group : groups) {
            if (group.frames.size() == places) {
                all.push_back(group);
                continue;
            }
            const Groups further = splitExactly(group.frames, columns);
            if (further.empty())
                return std::nullopt;
            for (const Group &one : further)
                all.push_back(within(group, one));
        }
        return all;
    }

    const Frames &m_frames;
    const task::Progress &m_progress;
    Indices m_all;
    std::vector<std::size_t> m_placeOf; ///< by frame: the number of its position
    std::size_t m_mostRepeats = 0;
    mutable int m_combinations = 0;
};

} // namespace

bool hasRepeatedPositions(const Frames &sorted) {
    return std::adjacent_find(sorted.begin(), sorted.end(), samePosition) != sorted.end();
}

std::vector<Part> splitRepeats(const Frames &sorted, const ReadAttributes &read,
                               const task::Progress &progress) {
    const Splitter splitter(sorted, progress);
    std::vector<Column> columns = headerColumns(sorted);
    Groups groups = splitter.split(columns);
    if (groups.empty() && read) {
        std::vector<Column> others = otherColumns(sorted, read, progress);
        std::move(others.begin(), others.end(), std::back_inserter(columns));
        groups = splitter.split(columns);
    }
    if (!groups.empty())
        return splitter.partsOf(groups);
    std::vector<Part> parts = splitter.partsOf(splitter.splitByNumber());
    for (Part &part : parts)
        part.warnings = {because::toldApartByNumber};
    return parts;
}

std::vector<Part> splitOverlapping(const Frames &sorted, const ReadAttributes &read,
                                   const task::Progress &progress) {
    const Splitter splitter(sorted, progress);
    Groups groups = splitter.splitOverlapping(headerColumns(sorted));
    if (groups.empty() && read)
        groups = splitter.splitOverlapping(otherColumns(sorted, read, progress));
    return splitter.partsOf(groups);
}

} // namespace pellucid::dicom
