// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/stack_geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

// A gap wider than this many medians is a hole in the patient, not a change of spacing.
constexpr double largestGapRatio = 2.5;

// Resampling may not multiply the slices by more than this: such gaps are strays, not a spacing.
constexpr double mostSlicesPerFrame = 4.0;

// Positions that differ by less are not rounded.
constexpr double exactMm = 1e-6;

// The mean, exactly the first value where all are the same.
template <class T, class F> T meanOf(const std::vector<PlacedFrame> &frames, F &&value) {
    const T first = value(frames.front().header);
    T sum(0.0);
    for (const PlacedFrame &frame : frames)
        sum += value(frame.header) - first;
    return first + sum / double(frames.size());
}

// What the planes of a stack have in common.
struct Plane {
    glm::dvec3 row, column, normal;
    glm::dvec2 spacingMm;
};

Plane meanPlane(const std::vector<PlacedFrame> &frames) {
    Plane plane{};
    plane.row = meanOf<glm::dvec3>(frames, [](const FrameHeader &h) { return *h.rowAxis; });
    plane.column = meanOf<glm::dvec3>(frames, [](const FrameHeader &h) { return *h.columnAxis; });
    plane.spacingMm = meanOf<glm::dvec2>(frames, [](const FrameHeader &h) { return *h.spacingMm; });
    const auto isFirst = [&](const FrameHeader &h) {
        return plane.row == *h.rowAxis && plane.column == *h.columnAxis;
    };
    if (!isFirst(frames.front().header)) { // means of unit vectors are a little short
        plane.row = glm::normalize(plane.row);
        plane.column = glm::normalize(plane.column - glm::dot(plane.row, plane.column) * plane.row);
    }
    plane.normal = glm::cross(plane.row, plane.column);
    return plane;
}

std::vector<task::Reason> jitterWarnings(const std::vector<PlacedFrame> &frames,
                                         const Plane &plane) {
    double axes = 0.0;
    glm::dvec2 finest = plane.spacingMm, coarsest = finest;
    for (const PlacedFrame &frame : frames) {
        axes = std::max({axes, glm::distance(*frame.header.rowAxis, plane.row),
                         glm::distance(*frame.header.columnAxis, plane.column)});
        finest = glm::min(finest, *frame.header.spacingMm);
        coarsest = glm::max(coarsest, *frame.header.spacingMm);
    }
    const glm::dvec2 off = coarsest / finest - 1.0;
    const double spacing = std::max(off.x, off.y);
    std::vector<task::Reason> warnings;
    if (axes >= jitterToReport)
        warnings.push_back(because::orientationsDiffer(
            fmt::format("{:.2f}", axes * 180.0 / 3.14159265358979323846)));
    if (spacing >= jitterToReport)
        warnings.push_back(because::pixelSpacingsDiffer(fmt::format("{:.1f}", 100.0 * spacing)));
    return warnings;
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

// depth = start + index * step, by least squares.
struct Line {
    double startMm = 0.0, stepMm = 0.0, worstMm = 0.0;
    bool isEven() const { return worstMm <= evennessToleranceMm(stepMm); }
};

Line lineThrough(std::span<const double> depths, std::span<const long> indices) {
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
    Line line;
    line.stepMm = product / square;
    line.startMm = meanDepth - meanIndex * line.stepMm;
    for (std::size_t n = 0; n < depths.size(); ++n)
        line.worstMm = std::max(
            line.worstMm, std::abs(depths[n] - line.startMm - double(indices[n]) * line.stepMm));
    return line;
}

struct Grid {
    Line line;
    std::vector<long> indices; ///< of the frames
};

// Every frame a slice and every slice a frame, or slices that are missing from an even grid.
std::optional<Grid> evenGrid(const std::vector<double> &depths, const std::vector<double> &gaps) {
    Grid grid;
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

// Neighbouring frames that are evenly spaced.
struct Run {
    std::size_t first = 0, gaps = 0;
    Line line;
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

// The grid of an uneven stack goes through its longest even run, or through one that is much finer
// and no accident: nothing that was scanned finely is to be lost. Nothing if the grid would have
// far more slices than there are frames.
std::optional<Line> anchoredLine(const std::vector<double> &depths) {
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
    Line line = chosen->line;
    line.startMm = std::abs(line.worstMm) < exactMm ? depths[chosen->first] : line.startMm;
    return line;
}

task::Reason unevenWarning(const std::vector<PlacedFrame> &frames, const std::vector<double> &gaps,
                           double step) {
    std::vector<task::Reason> changes;
    int listed = 0;
    for (std::size_t n = 1; n < gaps.size(); ++n)
        if (std::abs(gaps[n] - gaps[n - 1]) > evennessToleranceMm(gaps[n]) && ++listed <= 6)
            changes.push_back(because::unevenAt(frames[n].reference.path.filename().string(),
                                                fmt::format("{:.3g}", gaps[n - 1]),
                                                fmt::format("{:.3g}", gaps[n])));
    if (listed > 6)
        changes.push_back(because::more(listed - 6));
    if (changes.empty())
        changes.emplace_back(because::manyFiles);
    return because::unevenSlices(fmt::format("{:.3f}", step), std::move(changes));
}

// Slices that lie inside gaps, and what is said of them.
void fillGaps(const std::vector<PlacedFrame> &frames, const std::vector<double> &gaps,
              double leastGapMm, StackResult &result) {
    const std::vector<double> &at = result.geometry.frameOffsetsMm;
    const double step = result.geometry.lattice.sliceDistanceMm();
    const double near = evennessToleranceMm(step);
    int listed = 0;
    std::vector<task::Reason> places;
    for (std::size_t n = 0; n < gaps.size(); ++n) {
        if (gaps[n] <= leastGapMm)
            continue;
        const int first = int(std::floor((at[n] + near) / step)) + 1,
                  last = int(std::ceil((at[n + 1] - near) / step)) - 1;
        if (first > last)
            continue;
        result.filled.push_back({first, last});
        if (++listed <= 3)
            places.push_back(because::gapBetween(fmt::format("{:.1f}", gaps[n]),
                                                 frames[n].reference.path.filename().string(),
                                                 frames[n + 1].reference.path.filename().string()));
    }
    if (listed > 3)
        places.push_back(because::more(listed - 3));
    if (listed > 0)
        result.warnings.push_back(because::missingSlices(std::move(places)));
}

// The direction of the stack: one millimetre along the normal moves it by this much. Along the
// normal for a plain scan, askew for a tilted gantry.
struct Axis {
    glm::dvec3 startMm{0.0}, perMm{0.0}; ///< where depth is 0, counted from the first frame
};

Axis axisThrough(const std::vector<PlacedFrame> &frames, const std::vector<double> &depths) {
    const double count = double(frames.size());
    const glm::dvec3 first = *frames.front().header.positionMm;
    glm::dvec3 mean(0.0), product(0.0);
    double meanDepth = 0.0, square = 0.0;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        mean += (*frames[n].header.positionMm - first) / count;
        meanDepth += depths[n] / count;
    }
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const double off = depths[n] - meanDepth;
        product += off * (*frames[n].header.positionMm - first - mean);
        square += off * off;
    }
    const glm::dvec3 perMm = product / square;
    return {first + mean - meanDepth * perMm, perMm};
}

// Where nothing is rounded the first and the last position say it to the last digit.
Axis axisThroughEnds(const std::vector<PlacedFrame> &frames, double totalMm) {
    const glm::dvec3 first = *frames.front().header.positionMm;
    return {first, (*frames.back().header.positionMm - first) / totalMm};
}

void placeFrames(const std::vector<PlacedFrame> &frames, const Plane &plane, StackResult &result) {
    const glm::dvec3 across = plane.spacingMm.x * plane.row,
                     down = plane.spacingMm.y * plane.column;
    const int rows = frames.front().rows, columns = frames.front().columns,
              count = int(frames.size());
    if (count == 1) {
        const FrameHeader &only = frames.front().header;
        const double thickness = only.sliceThicknessMm > 0.0 ? only.sliceThicknessMm : 1.0;
        result.geometry.lattice = volume::Lattice::make({columns, rows, 1}, {*only.positionMm},
                                                        {across, down, thickness * plane.normal});
        return;
    }
    std::vector<double> depths;
    for (const PlacedFrame &frame : frames)
        depths.push_back(frame.depthMm - frames.front().depthMm);
    const double total = depths.back();
    if (!std::isfinite(total) || !(total > 0.0)) {
        result.refusal = because::slicesAtOnePosition;
        return;
    }
    Axis axis = axisThrough(frames, depths);
    const double stray = std::max(0.15, 0.1 * std::min(plane.spacingMm.x, plane.spacingMm.y));
    double worst = 0.0;
    const PlacedFrame *strayed = nullptr;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const double off =
            glm::distance(*frames[n].header.positionMm, axis.startMm + depths[n] * axis.perMm);
        if (!(off <= worst)) {
            worst = off;
            strayed = &frames[n];
        }
    }
    if (!(worst <= stray)) {
        result.refusal = because::sliceOffTheLine(strayed->reference.path.filename().string(),
                                                  fmt::format("{:.2f}", worst));
        return;
    }
    if (worst < exactMm)
        axis = axisThroughEnds(frames, total);
    const auto place = [&](double startMm, double stepMm, long slices) {
        result.geometry.lattice = volume::Lattice::make({columns, rows, int(slices)},
                                                        {axis.startMm + startMm * axis.perMm},
                                                        {across, down, stepMm * axis.perMm});
    };
    const std::vector<double> gaps = gapsOf(depths);
    if (auto grid = evenGrid(depths, gaps)) {
        if (grid->line.worstMm < exactMm)
            grid->line = {0.0, total / double(grid->indices.back()), 0.0};
        place(grid->line.startMm, grid->line.stepMm, grid->indices.back() + 1);
        if (grid->indices.back() + 1 == count)
            return;
        // Frames are taken for what their place on the grid is: they stay as they are.
        const double step = result.geometry.lattice.sliceDistanceMm();
        for (const long index : grid->indices)
            result.geometry.frameOffsetsMm.push_back(double(index) * step);
        fillGaps(frames, gaps, 1.5 * step, result);
        return;
    }
    const std::optional<Line> anchored = anchoredLine(depths);
    if (!anchored) {
        const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
        result.refusal = because::slicesWithoutCommonStep(fmt::format("{:.3f}", *least),
                                                          fmt::format("{:.1f}", *most));
        return;
    }
    const Line &line = *anchored;
    // Both ends are inside: what lies beyond the outermost frame repeats it.
    const double slack = evennessToleranceMm(line.stepMm) / line.stepMm;
    const double below = std::ceil(line.startMm / line.stepMm - slack),
                 above = std::ceil((total - line.startMm) / line.stepMm - slack);
    const double start = line.startMm - below * line.stepMm;
    place(start, line.stepMm, long(below + above) + 1);
    const double step = result.geometry.lattice.sliceDistanceMm();
    for (const double depth : depths) {
        // A frame that is a slice stays as it is.
        std::vector<double> &at = result.geometry.frameOffsetsMm;
        const double off = depth - start, whole = std::round(off / step) * step;
        const bool isSlice =
            std::abs(off - whole) <= evennessToleranceMm(step) && (at.empty() || whole > at.back());
        at.push_back(isSlice ? whole : std::max(off, at.empty() ? off : at.back()));
    }
    result.warnings.push_back(unevenWarning(frames, gaps, line.stepMm));
    fillGaps(frames, gaps, largestGapRatio * median(gaps), result);
}

} // namespace

void sortByDepth(std::vector<PlacedFrame> &frames) {
    const glm::dvec3 normal = meanPlane(frames).normal;
    for (PlacedFrame &frame : frames)
        frame.depthMm = glm::dot(normal, *frame.header.positionMm);
    std::stable_sort(frames.begin(), frames.end(), [](const PlacedFrame &a, const PlacedFrame &b) {
        return a.depthMm < b.depthMm;
    });
}

// 0.05 mm is what a position with one decimal is off, on each of the axes that it is composed of.
double evennessToleranceMm(double spacingMm) {
    return std::min(std::max(0.09, 0.02 * std::abs(spacingMm)), 0.15 * std::abs(spacingMm));
}

std::vector<std::pair<std::size_t, std::size_t>> runsOf(const std::vector<PlacedFrame> &frames) {
    std::vector<std::pair<std::size_t, std::size_t>> runs{{0, frames.size()}};
    if (frames.size() < 3)
        return runs;
    std::vector<double> depths;
    for (const PlacedFrame &frame : frames)
        depths.push_back(frame.depthMm);
    const std::vector<double> gaps = gapsOf(depths);
    const double widest = largestGapRatio * median(gaps);
    for (std::size_t n = 0; n < gaps.size(); ++n)
        if (gaps[n] > widest) {
            runs.back().second = n + 1;
            runs.emplace_back(n + 1, frames.size());
        }
    return runs;
}

bool isOfStack(const task::Reason &warning) {
    return warning.is(because::unevenSlices) || warning.is(because::missingSlices) ||
           warning.is(because::orientationsDiffer) || warning.is(because::pixelSpacingsDiffer);
}

StackResult stackGeometry(const std::vector<PlacedFrame> &frames) {
    StackResult result;
    try {
        const Plane plane = meanPlane(frames);
        result.warnings = jitterWarnings(frames, plane);
        placeFrames(frames, plane, result);
    } catch (const task::Error &error) {
        result.refusal = error.reason();
    }
    return result;
}

} // namespace pellucid::dicom
