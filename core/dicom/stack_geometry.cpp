// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dicom/stack_geometry.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/task/error.h"

namespace pellucid::dicom {

namespace {

// A gap wider than this many medians is a hole in the patient, not a change of spacing.
constexpr double largestGapRatio = 2.5;

// Resampling may not multiply the slices by more than this: such gaps are strays, not a spacing.
constexpr double mostSlicesPerFrame = 4.0;

glm::dvec3 normalOf(const FrameHeader &h) {
    return glm::cross(*h.rowAxis, *h.columnAxis);
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

double smallestRepeatedGap(const std::vector<double> &gaps) {
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t n = 1; n < sorted.size(); ++n)
        if (sorted[n] - sorted[n - 1] <= spacingToleranceMm(sorted[n - 1])) {
            // The mean of all gaps of that size, so that rounded positions do not add up.
            double sum = 0.0;
            int count = 0;
            for (const double gap : sorted)
                if (std::abs(gap - sorted[n - 1]) <= spacingToleranceMm(gap)) {
                    sum += gap;
                    ++count;
                }
            return sum / count;
        }
    return sorted.front();
}

std::string unevenWarning(const std::vector<PlacedFrame> &frames, const std::vector<double> &gaps,
                          double step) {
    std::string changes;
    int listed = 0;
    for (std::size_t n = 1; n < gaps.size(); ++n)
        if (std::abs(gaps[n] - gaps[n - 1]) > spacingToleranceMm(gaps[n]) && ++listed <= 6)
            changes +=
                fmt::format("{}{} ({:.3g} then {:.3g} mm)", changes.empty() ? "" : ", ",
                            frames[n].reference.path.filename().string(), gaps[n - 1], gaps[n]);
    if (listed > 6)
        changes += fmt::format(" and {} more", listed - 6);
    return fmt::format("uneven slice distances, resampled onto {:.3f} mm; they change at {}", step,
                       changes);
}

} // namespace

void sortByDepth(std::vector<PlacedFrame> &frames) {
    const glm::dvec3 normal = normalOf(frames.front().header);
    for (PlacedFrame &frame : frames)
        frame.depthMm = glm::dot(normal, *frame.header.positionMm);
    std::stable_sort(frames.begin(), frames.end(), [](const PlacedFrame &a, const PlacedFrame &b) {
        return a.depthMm < b.depthMm;
    });
}

// Positions are written with a few digits; half a percent also absorbs a tenth rounded off 20 mm.
double spacingToleranceMm(double spacingMm) {
    return std::max(0.01, 0.005 * std::abs(spacingMm));
}

StackResult stackGeometry(const std::vector<PlacedFrame> &frames) {
    const FrameHeader &first = frames.front().header, &last = frames.back().header;
    const glm::dvec3 normal = normalOf(first);
    const glm::dvec3 across = first.spacingMm->x * *first.rowAxis,
                     down = first.spacingMm->y * *first.columnAxis;
    const int rows = frames.front().rows, columns = frames.front().columns,
              count = int(frames.size());
    StackResult result;
    try {
        if (count == 1) {
            const double thickness = first.sliceThicknessMm > 0.0 ? first.sliceThicknessMm : 1.0;
            result.geometry.lattice = volume::Lattice::make({columns, rows, 1}, {*first.positionMm},
                                                            {across, down, thickness * normal});
            return result;
        }
        std::vector<double> depths;
        for (const PlacedFrame &frame : frames)
            depths.push_back(frame.depthMm - frames.front().depthMm);
        const double total = depths.back();
        if (!std::isfinite(total) || !(total > 0.0)) {
            result.refusal = "the slices lie at one place";
            return result;
        }
        // One millimetre along the normal moves the stack by this much: along the normal for a
        // plain scan, askew for a tilted gantry.
        const glm::dvec3 along = (*last.positionMm - *first.positionMm) / total;
        const double stray = std::max(0.05, 0.1 * std::min(first.spacingMm->x, first.spacingMm->y));
        for (int n = 0; n < count; ++n) {
            const glm::dvec3 off =
                *frames[n].header.positionMm - (*first.positionMm + depths[n] * along);
            if (!(glm::length(off) <= stray)) {
                result.refusal =
                    fmt::format("{} lies {:.2f} mm beside the line of the other slices",
                                frames[n].reference.path.filename().string(), glm::length(off));
                return result;
            }
        }
        const std::vector<double> gaps = gapsOf(depths);
        const double mean = total / (count - 1);
        // Gaps that creep by less than the tolerance each may add up: the places count too.
        bool even = true;
        for (int n = 1; n < count; ++n)
            even = even && std::abs(gaps[std::size_t(n) - 1] - mean) <= spacingToleranceMm(mean) &&
                   std::abs(depths[std::size_t(n)] - n * mean) <= std::max(0.02, 0.05 * mean);
        if (even) {
            result.geometry.lattice = volume::Lattice::make(
                {columns, rows, count}, {*first.positionMm}, {across, down, mean * along});
            return result;
        }
        const double typical = median(gaps);
        const auto widest = std::max_element(gaps.begin(), gaps.end());
        if (*widest > largestGapRatio * typical) {
            const auto at = std::size_t(widest - gaps.begin());
            result.refusal = fmt::format(
                "a gap of {:.1f} mm between {} and {}; slices are {:.1f} mm apart elsewhere",
                *widest, frames[at].reference.path.filename().string(),
                frames[at + 1].reference.path.filename().string(), typical);
            return result;
        }
        const double step = smallestRepeatedGap(gaps);
        if (total / step + 1.0 > mostSlicesPerFrame * count) {
            result.refusal = fmt::format("slice distances from {:.3f} to {:.1f} mm have no common "
                                         "step",
                                         *std::min_element(gaps.begin(), gaps.end()), *widest);
            return result;
        }
        // A step that ends a little past the last frame still belongs to it.
        const int slices = int(std::floor(total / step + 0.01)) + 1;
        result.geometry.lattice = volume::Lattice::make(
            {columns, rows, slices}, {*first.positionMm}, {across, down, step * along});
        result.geometry.frameOffsetsMm = depths;
        result.warnings.push_back(unevenWarning(frames, gaps, step));
    } catch (const task::Error &error) {
        result.refusal = error.reason();
    }
    return result;
}

} // namespace pellucid::dicom
