// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/slice_spacing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

namespace pellucid::dicom {

namespace {

// Resampling may not multiply the slices by more than this: a spacing that small comes from stray
// frames.
constexpr double maxSlicesPerFrame = 4.0;

// A line has a closed form of ten lines. Eigen's QR of the same system changes the last bits of the
// step in 19 of 20 series, by 1e-14 mm, and the lattice of the volume with them; the file would
// take 7 s to compile instead of 0.7 s.
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

// Consecutive frames that are evenly spaced.
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
        // The number of gaps is doubled while the run is even; bisection then finds its end.
        const std::size_t longest = depths.size() - 1 - first;
        std::size_t even = 1, uneven = 2;
        while (uneven <= longest && line(uneven).isEven()) {
            even = uneven;
            uneven *= 2;
        }
        uneven = std::min(uneven, longest + 1);
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

// A position with one decimal is off by up to 0.05 mm on each of its axes.
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
    // Depths are rounded to whole steps of a line, and the line is refitted, in turns.
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
            // From frame to frame at first, because the error of a rough step accumulates.
            const double steps =
                round == 0 ? (n == 0 ? 0.0 : double(last) + gaps[n - 1] / grid.line.stepMm)
                           : (depths[n] - grid.line.startMm) / grid.line.stepMm;
            // So many missing slices are not plausible.
            if (!(steps < maxSlicesPerFrame * double(depths.size()) + 1.0))
                return std::nullopt;
            const long index = std::lround(steps);
            if (index <= last)
                return std::nullopt;
            last = grid.indices[n] = index;
        }
        grid.line = lineThrough(depths, grid.indices);
    }
    // The first frame must be the first slice.
    return grid.line.isEven() && grid.indices.front() == 0 ? std::optional(grid) : std::nullopt;
}

std::optional<SliceLine> anchoredLine(const std::vector<double> &depths) {
    constexpr double muchFiner = 0.75;
    constexpr std::size_t minGaps = 3; // fewer equal gaps may be a coincidence
    const std::vector<Run> runs = evenRuns(depths);
    const auto fits = [&](const Run &run) {
        return depths.back() / run.line.stepMm + 1.0 <= maxSlicesPerFrame * double(depths.size());
    };
    const Run *chosen = &*std::max_element(
        runs.begin(), runs.end(), [](const Run &a, const Run &b) { return a.gaps < b.gaps; });
    if (!fits(*chosen))
        return std::nullopt;
    for (const Run &run : runs)
        if (fits(run) && run.gaps >= minGaps && run.line.stepMm < muchFiner * chosen->line.stepMm)
            chosen = &run;
    SliceLine line = chosen->line;
    line.startMm = std::abs(line.worstMm) < exactMm ? depths[chosen->first] : line.startMm;
    return line;
}

} // namespace pellucid::dicom
