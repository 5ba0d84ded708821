// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/split_exactly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace pellucid::dicom {

namespace {

double narrowestGap(const std::vector<double> &sorted) {
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < sorted.size(); ++n)
        gap = std::min(gap, sorted[n] - sorted[n - 1]);
    return gap;
}

bool follows(const std::vector<double> &before, const std::vector<double> &here, double tolerance) {
    double drift = 0.0;
    for (std::size_t n = 0; n < here.size(); ++n)
        drift += (here[n] - before[n]) / double(here.size());
    const double most = tolerance * std::min(narrowestGap(before), narrowestGap(here));
    for (std::size_t n = 0; n < here.size(); ++n)
        if (!(std::abs(here[n] - before[n] - drift) < most))
            return false;
    return true;
}

class ExactSplitter {
public:
    ExactSplitter(const RepeatedFrames &stack, const std::vector<Column> &columns, Telling telling)
        : m_stack(stack), m_columns(columns), m_telling(telling) {}

    FrameGroups split(const FrameIndices &frames) {
        const std::size_t each = m_stack.repeatsOfEach(frames);
        // Attributes that a file makes up could be combined for ever.
        constexpr int mostCombinations = 10000;
        if (each < 2 || ++m_combinations > mostCombinations)
            return {};
        const std::size_t places = frames.size() / each;
        for (const Column &column : m_columns) {
            FrameGroups groups = m_stack.byValue(frames, column);
            if (groups.size() < 2)
                continue;
            const bool isUniform =
                std::all_of(groups.begin(), groups.end(), [&](const FrameGroup &group) {
                    const std::size_t ofGroup = m_stack.repeatsOfEach(group.frames);
                    return ofGroup > 0 && ofGroup * places == group.frames.size();
                });
            if (isUniform) {
                if (auto all = splitFurther(groups, places))
                    return std::move(*all);
            } else if (m_telling == Telling::alsoByRank) {
                if (FrameGroups ranked = byRank(frames, column, each); !ranked.empty())
                    return ranked;
            }
        }
        return {};
    }

private:
    // Splits those that still repeat by further attributes.
    std::optional<FrameGroups> splitFurther(const FrameGroups &groups, std::size_t places) {
        FrameGroups all;
        for (const FrameGroup &group : groups) {
            if (group.frames.size() == places) {
                all.push_back(group);
                continue;
            }
            const FrameGroups further = split(group.frames);
            if (further.empty())
                return std::nullopt;
            for (const FrameGroup &one : further)
                all.push_back(within(group, one));
        }
        return all;
    }

    // By the order of the values at each position. Empty if it means nothing: from one position to
    // the next the values of a part must keep closer together than those of different parts, apart
    // from a drift that all have in common.
    FrameGroups byRank(const FrameIndices &frames, const Column &column, std::size_t each) const {
        const std::size_t places = frames.size() / each;
        // Noise follows itself by chance: in a few positions, or among many attributes.
        constexpr std::size_t manyPairs = 12;
        const std::size_t pairs = (places - 1) * (each - 1);
        if (!column.mayDrift() || places < minSlices || (!column.isKnown() && pairs < manyPairs))
            return {};
        const double tolerance = column.isKnown() ? 0.5 : 0.25; // of the narrowest gap
        std::vector<double> before, here(each);
        FrameGroups groups(each);
        for (std::size_t place = 0; place < places; ++place) {
            m_stack.check();
            FrameIndices at(frames.begin() + std::ptrdiff_t(place * each),
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
        for (FrameGroup &group : groups)
            group.label = {column.labelOf(column.idOf(group.frames[group.frames.size() / 2]))};
        return groups;
    }

    const RepeatedFrames &m_stack;
    const std::vector<Column> &m_columns;
    Telling m_telling;
    int m_combinations = 0;
};

} // namespace

FrameGroups splitExactly(const RepeatedFrames &frames, const std::vector<Column> &columns,
                         Telling telling) {
    return ExactSplitter(frames, columns, telling).split(frames.all());
}

} // namespace pellucid::dicom
