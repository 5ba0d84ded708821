// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/stack_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/dicom/reasons.h"
#include "core/dicom/slice_spacing.h"
#include "core/task/error.h"
#include "core/task/reasons.h"

namespace pellucid::dicom {

namespace {

namespace because = task::because;

// A gap of more than this many medians is a hole, not a change of spacing.
constexpr double largestGapRatio = 2.5;

// The mean, which is exactly the first value if all are equal.
template <class T, class F> T meanOf(const std::vector<PlacedFrame> &frames, F &&value) {
    const T first = value(frames.front().header);
    T sum(0.0);
    for (const PlacedFrame &frame : frames)
        sum += value(frame.header) - first;
    return first + sum / double(frames.size());
}

// The common plane parameters of a stack.
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
    if (!isFirst(frames.front().header)) { // means of unit vectors are slightly short
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

// Finds the slices within gaps, and adds the warnings about them.
void fillGaps(const std::vector<PlacedFrame> &frames, const std::vector<double> &gaps,
              double minGapMm, StackResult &result) {
    const std::vector<double> &at = result.geometry.frameOffsetsMm;
    const double step = result.geometry.lattice.sliceDistanceMm();
    const double near = evennessToleranceMm(step);
    int listed = 0;
    std::vector<task::Reason> places;
    for (std::size_t n = 0; n < gaps.size(); ++n) {
        if (gaps[n] <= minGapMm)
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

// The direction of the stack, as the shift per millimetre along the normal: along the normal itself
// for a plain scan, oblique for a tilted gantry.
struct Axis {
    glm::dvec3 startMm{0.0}, perMm{0.0}; ///< startMm: at depth 0, relative to the first frame
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

// If nothing is rounded, the first and the last position define it to the last digit.
Axis axisThroughEnds(const std::vector<PlacedFrame> &frames, double totalMm) {
    const glm::dvec3 first = *frames.front().header.positionMm;
    return {first, (*frames.back().header.positionMm - first) / totalMm};
}

// Computes the lattice of a stack, or the reason why there is none.
class StackPlacement {
public:
    StackPlacement(const std::vector<PlacedFrame> &frames, const Plane &plane, StackResult &result)
        : m_frames(frames), m_plane(plane), m_result(result) {
        for (const PlacedFrame &frame : frames)
            m_depths.push_back(frame.depthMm - frames.front().depthMm);
        m_gaps = gapsOf(m_depths);
    }

    void place(Slices slices) {
        if (m_frames.size() == 1) {
            placeSingle();
            return;
        }
        m_result.refusal = findAxis();
        if (m_result.refusal)
            return;
        if (slices == Slices::arriving)
            placeSlices(0.0, m_depths.back() / double(m_gaps.size()), long(m_frames.size()));
        else if (auto grid = evenGrid(m_depths, m_gaps))
            placeOnGrid(std::move(*grid));
        else if (const auto line = anchoredLine(m_depths))
            resampleOnto(*line);
        else
            m_result.refusal = noCommonStep();
    }

private:
    void placeSingle() {
        const FrameHeader &only = m_frames.front().header;
        const double thickness = only.sliceThicknessMm > 0.0 ? only.sliceThicknessMm : 1.0;
        m_result.geometry.lattice = latticeOf(*only.positionMm, thickness * m_plane.normal, 1);
    }

    // Returns the reason if there is none.
    std::optional<task::Reason> findAxis() {
        const double total = m_depths.back();
        if (!std::isfinite(total) || !(total > 0.0))
            return because::slicesAtOnePosition;
        m_axis = axisThrough(m_frames, m_depths);
        const double tolerance = lineToleranceMm(m_plane.spacingMm);
        double worst = 0.0;
        const PlacedFrame *outlier = nullptr;
        for (std::size_t n = 0; n < m_frames.size(); ++n) {
            const double off = glm::distance(*m_frames[n].header.positionMm,
                                             m_axis.startMm + m_depths[n] * m_axis.perMm);
            if (!(off <= worst)) {
                worst = off;
                outlier = &m_frames[n];
            }
        }
        if (!(worst <= tolerance))
            return because::sliceOffTheLine(outlier->reference.path.filename().string(),
                                            fmt::format("{:.2f}", worst));
        if (worst < exactMm)
            m_axis = axisThroughEnds(m_frames, total);
        return std::nullopt;
    }

    // Frames count as being at their grid positions: their samples are not changed.
    void placeOnGrid(EvenGrid grid) {
        const long last = grid.indices.back();
        if (grid.line.worstMm < exactMm)
            grid.line = {0.0, m_depths.back() / double(last), 0.0};
        placeSlices(grid.line.startMm, grid.line.stepMm, last + 1);
        if (last + 1 == int(m_frames.size()))
            return;
        const double step = m_result.geometry.lattice.sliceDistanceMm();
        for (const long index : grid.indices)
            m_result.geometry.frameOffsetsMm.push_back(double(index) * step);
        fillGaps(m_frames, m_gaps, 1.5 * step, m_result);
    }

    // Both ends are within the stack: slices beyond the outermost frame would repeat it.
    void resampleOnto(const SliceLine &line) {
        const double slack = evennessToleranceMm(line.stepMm) / line.stepMm;
        const double below = std::ceil(line.startMm / line.stepMm - slack),
                     above = std::ceil((m_depths.back() - line.startMm) / line.stepMm - slack);
        const double start = line.startMm - below * line.stepMm;
        placeSlices(start, line.stepMm, long(below + above) + 1);
        const double step = m_result.geometry.lattice.sliceDistanceMm();
        std::vector<double> &at = m_result.geometry.frameOffsetsMm;
        for (const double depth : m_depths) {
            // A frame at a slice's position is used unchanged.
            const double off = depth - start, whole = std::round(off / step) * step;
            const bool isSlice = std::abs(off - whole) <= evennessToleranceMm(step) &&
                                 (at.empty() || whole > at.back());
            at.push_back(isSlice ? whole : std::max(off, at.empty() ? off : at.back()));
        }
        m_result.warnings.push_back(unevenWarning(m_frames, m_gaps, line.stepMm));
        fillGaps(m_frames, m_gaps, largestGapRatio * median(m_gaps), m_result);
    }

    task::Reason noCommonStep() const {
        const auto [least, most] = std::minmax_element(m_gaps.begin(), m_gaps.end());
        return because::slicesWithoutCommonStep(fmt::format("{:.3f}", *least),
                                                fmt::format("{:.1f}", *most));
    }

    void placeSlices(double startMm, double stepMm, long slices) {
        m_result.geometry.lattice =
            latticeOf(m_axis.startMm + startMm * m_axis.perMm, stepMm * m_axis.perMm, int(slices));
    }
    volume::Lattice latticeOf(const glm::dvec3 &originMm, const glm::dvec3 &stepMm,
                              int slices) const {
        const PlacedFrame &first = m_frames.front();
        return volume::Lattice::make(
            {first.columns, first.rows, slices}, {originMm},
            {m_plane.spacingMm.x * m_plane.row, m_plane.spacingMm.y * m_plane.column, stepMm});
    }

    const std::vector<PlacedFrame> &m_frames;
    const Plane &m_plane;
    StackResult &m_result;
    std::vector<double> m_depths, m_gaps; ///< relative to the first frame, mm
    Axis m_axis;
};

// Empty if the frames are in line, or the stacks between the shifts are not.
std::vector<Break> shiftsOf(const std::vector<PlacedFrame> &frames,
                            const std::vector<double> &gaps) {
    const Plane plane = meanPlane(frames);
    std::vector<glm::dvec2> steps; // within the plane
    std::vector<double> perMm[2];
    for (std::size_t n = 0; n < gaps.size(); ++n) {
        const glm::dvec3 step = *frames[n + 1].header.positionMm - *frames[n].header.positionMm;
        steps.emplace_back(glm::dot(step, plane.row), glm::dot(step, plane.column));
        for (int axis = 0; axis < 2; ++axis)
            perMm[axis].push_back(gaps[n] > 0.0 ? steps.back()[axis] / gaps[n] : 0.0);
    }
    const glm::dvec2 tilt(median(perMm[0]), median(perMm[1]));
    std::vector<Break> shifts;
    for (std::size_t n = 0; n < gaps.size(); ++n)
        // Both frames may be off the line by its tolerance.
        if (const double shift = glm::length(steps[n] - tilt * gaps[n]);
            shift > 2.0 * lineToleranceMm(plane.spacingMm))
            shifts.push_back({n + 1, gaps[n], shift});
    std::size_t first = 0;
    for (std::size_t n = 0; n <= shifts.size(); ++n) {
        const std::size_t end = n < shifts.size() ? shifts[n].at : frames.size();
        const std::vector<PlacedFrame> run(frames.begin() + std::ptrdiff_t(first),
                                           frames.begin() + std::ptrdiff_t(end));
        if (shifts.empty() || run.size() < 2 || stackGeometry(run).refusal)
            return {};
        first = end;
    }
    return shifts;
}

} // namespace

double lineToleranceMm(const glm::dvec2 &spacingMm) {
    return std::max(0.15, 0.1 * std::min(spacingMm.x, spacingMm.y));
}

bool sameDepth(const PlacedFrame &a, const PlacedFrame &b) {
    return std::abs(a.depthMm - b.depthMm) < 0.01;
}

void sortByDepth(std::vector<PlacedFrame> &frames) {
    const Plane plane = meanPlane(frames);
    for (PlacedFrame &frame : frames) {
        const glm::dvec3 &at = *frame.header.positionMm;
        frame.depthMm = glm::dot(plane.normal, at);
        frame.placeMm = {glm::dot(plane.row, at), glm::dot(plane.column, at)};
    }
    std::stable_sort(frames.begin(), frames.end(), [](const PlacedFrame &a, const PlacedFrame &b) {
        return a.depthMm < b.depthMm;
    });
}

std::vector<Break> breaksOf(const std::vector<PlacedFrame> &frames) {
    if (frames.size() < 3)
        return {};
    std::vector<double> depths;
    for (const PlacedFrame &frame : frames)
        depths.push_back(frame.depthMm);
    const std::vector<double> gaps = gapsOf(depths);
    const double widest = largestGapRatio * median(gaps);
    std::vector<Break> breaks;
    for (std::size_t n = 0; n < gaps.size(); ++n)
        if (gaps[n] > widest)
            breaks.push_back({n + 1, gaps[n], 0.0});
    return breaks.empty() ? shiftsOf(frames, gaps) : breaks;
}

bool isStackWarning(const task::Reason &warning) {
    return warning.is(because::unevenSlices) || warning.is(because::missingSlices) ||
           warning.is(because::orientationsDiffer) || warning.is(because::pixelSpacingsDiffer);
}

StackResult stackGeometry(const std::vector<PlacedFrame> &frames, Slices slices) {
    StackResult result;
    try {
        const Plane plane = meanPlane(frames);
        result.warnings = jitterWarnings(frames, plane);
        StackPlacement(frames, plane, result).place(slices);
    } catch (const task::Error &error) {
        result.refusal = error.reason();
    }
    return result;
}

} // namespace pellucid::dicom
