// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/slice_spacing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

namespace pellucid::dicom {

namespace {

// Resampling may not multiply the slices by more than this: such gaps are strays, not a spacing.
constexpr double mostSlicesPerFrame = 4.0;

SliceLine lineThrough(std::span<const double> depths, std::span<const long> indices) {
    const double count = double(depths.size());
    double meanDepth = 0.0, meanIndex = 0.0, product = 0.0, square = 0.0;
    for (std::size_t n = 0; n < depths.size(); ++n) {
        meanDepth += depths[n] / count;
        meanIndex += double(indices[n]) / count;
    }
    for (std::size_t n = 0; n < depths.size(); ++n) {
        product += (double(indices[n]) - meanIndex) * (depths[n] - meanDepth);
        square += (double(indices[n]) - meanIndex) * (double(indices[n]) - meanIndex);
    }
    SliceLine line;
    line.stepMm = product / square;
    line.startMm = meanDepth - meanIndex * line.stepMm;
    for (std::size_t n = 0; n < depths.size(); ++n)
        line.worstMm = std::max(
            line.worstMm, std::abs(depths[n] - line.startMm - double(indices[n]) * line.stepMm));
    return line;
}

// Neighbouring frames that are evenly spaced.
struct Run {
    std::size_t first = 0, gaps = 0;
    SliceLine line;
};

std::vector<Run> evenRuns(const std::vector<double> &depths) {
    std::vector<long> indices(depths.size());
    std::iota(indices.begin(), indices.end(), 0L);
    std::vector<Run> runs;
    for (std::size_t first = 0; first + 1 < depths.size();) {
        const auto line = [&](std::size_t gaps) {
            return lineThrough(std::span(depths).subspan(first, gaps + 1),
                               std::span(indices).first(gaps + 1));
        };
        // As long as it is even: doubled until it is not, then halved down to the end.
        const std::size_t most = depths.size() - 1 - first;
        std::size_t even = 1, uneven = 2;
        while (uneven <= most && line(uneven).isEven()) {
            even = uneven;
            uneven *= 2;
        }
        uneven = std::min(uneven, most + 1);
        while (uneven - even > 1) {
            const std::size_t middle = (even + uneven) / 2;
            (line(middle).isEven() ? even : uneven) = middle;
        }
        runs.push_back({first, even, line(even)});
        first += even;
    }
    return runs;
}

} // namespace

// 0.05 mm is what a position with one decimal is off, on each of the axes that it is composed of.
double evennessToleranceMm(double spacingMm) {
    return std::min(std::max(0.09, 0.02 * std::abs(spacingMm)), 0.15 * std::abs(spacingMm));
}

std::vector<double> gapsOf(const std::vector<double> &depths) {
    std::vector<double> gaps;
    for (std::size_t n = 1; n < depths.size(); ++n)
        gaps.push_back(depths[n] - depths[n - 1]);
    return gaps;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

std::optional<EvenGrid> evenGrid(const std::vector<double> &depths,
                                 const std::vector<double> &gaps) {
    EvenGrid grid;
    grid.indices.resize(depths.size());
    std::iota(grid.indices.begin(), grid.indices.end(), 0L);
    grid.line = lineThrough(depths, grid.indices);
    if (grid.line.isEven())
        return grid;
    // Rounding to whole steps is refined by the line that it leads to.
    const double typical = median(gaps);
    double sum = 0.0;
    int count = 0;
    for (const double gap : gaps)
        if (std::abs(gap - typical) < 0.3 * typical) {
            sum += gap;
            ++count;
        }
    grid.line = {depths.front(), sum / count, 0.0};
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        long last = -1;
        for (std::size_t n = 0; n < depths.size(); ++n) {
            // From frame to frame at first: a step that is a little wrong adds up.
            const double steps =
                round == 0 ? (n == 0 ? 0.0 : double(last) + gaps[n - 1] / grid.line.stepMm)
                           : (depths[n] - grid.line.startMm) / grid.line.stepMm;
            // Beyond that it is no grid of slices that are missing.
            if (!(steps < mostSlicesPerFrame * double(depths.size()) + 1.0))
                return std::nullopt;
            const long index = std::lround(steps);
            if (index <= last)
                return std::nullopt;
            last = grid.indices[n] = index;
        }
        grid.line = lineThrough(depths, grid.indices);
    }
    // The first frame is a slice of its own, too.
    return grid.line.isEven() && grid.indices.front() == 0 ? std::optional(grid) : std::nullopt;
}

std::optional<SliceLine> anchoredLine(const std::vector<double> &depths) {
    constexpr double muchFiner = 0.75;
    constexpr std::size_t noAccident = 3;
    const std::vector<Run> runs = evenRuns(depths);
    const auto fits = [&](const Run &run) {
        return depths.back() / run.line.stepMm + 1.0 <= mostSlicesPerFrame * double(depths.size());
    };
    const Run *chosen = &*std::max_element(
        runs.begin(), runs.end(), [](const Run &a, const Run &b) { return a.gaps < b.gaps; });
    if (!fits(*chosen))
        return std::nullopt;
    for (const Run &run : runs)
        if (fits(run) && run.gaps >= noAccident &&
            run.line.stepMm < muchFiner * chosen->line.stepMm)
            chosen = &run;
    SliceLine line = chosen->line;
    line.startMm = std::abs(line.worstMm) < exactMm ? depths[chosen->first] : line.startMm;
    return line;
}

} // namespace pellucid::dicom
