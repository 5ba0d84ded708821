// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/segment/contour_masks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <tbb/parallel_for.h>

#include "core/segment/reasons.h"
#include "core/system/memory.h"
#include "core/task/error.h"

namespace pellucid::segment {

namespace {

namespace because = task::because;
using volume::Lattice;

constexpr int linesPerPixel = 16;
// Contours are written with rounded coordinates.
constexpr double flatnessMm = 0.1;

[[noreturn]] void fail(const task::Reason &reason) {
    throw task::Error(task::ErrorCode::unusable, reason);
}

// A grid in the contours' plane: the rows and columns of the lattice's slices, or others.
struct Frame {
    glm::dvec3 origin;
    glm::dmat3 steps;    // of a column, of a row, and to the plane 1 mm along the normal
    glm::dmat3 toPixels; // and mm along the normal
};

// `across`: from a plane to others; oblique for a tilted lattice.
Frame frameOf(const glm::dvec3 &origin, const glm::dvec3 &columnStep, const glm::dvec3 &rowStep,
              const glm::dvec3 &across) {
    const glm::dvec3 normal = glm::normalize(glm::cross(columnStep, rowStep));
    const glm::dmat3 steps(columnStep, rowStep, across / glm::dot(across, normal));
    return {origin, steps, glm::inverse(steps)};
}

// Newell's normal: that of the plane that fits best, times twice the enclosed area.
glm::dvec3 normalOf(std::span<const glm::dvec3> contour) {
    glm::dvec3 sum{0.0};
    for (std::size_t n = 0; n < contour.size(); ++n)
        sum += glm::cross(contour[n] - contour[0], contour[(n + 1) % contour.size()] - contour[0]);
    return sum;
}

// Whether all points are in one plane across the frame's normal.
bool isInPlane(std::span<const glm::dvec3> contour, const Frame &frame) {
    double low = 1e30, high = -1e30;
    for (const glm::dvec3 &point : contour) {
        const double at = (frame.toPixels * (point - frame.origin)).z;
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return high - low <= 2.0 * flatnessMm;
}

Frame frameOfSlices(const Lattice &lattice) {
    return frameOf(lattice.origin().mm, lattice.step(0), lattice.step(1), lattice.step(2));
}

bool areAlong(const std::vector<std::span<const glm::dvec3>> &contours, const Frame &frame) {
    return std::all_of(contours.begin(), contours.end(),
                       [&](const auto &contour) { return isInPlane(contour, frame); });
}

// In the plane of the largest contour.
Frame ownFrame(const std::vector<std::span<const glm::dvec3>> &contours, const Lattice &lattice) {
    glm::dvec3 normal{0.0};
    for (const auto &contour : contours)
        if (const glm::dvec3 own = normalOf(contour); glm::length(own) > glm::length(normal))
            normal = own;
    if (!(glm::length(normal) > 0.0))
        fail(because::contoursNotPlanar);
    normal = glm::normalize(normal);
    const glm::dvec3 aside = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const double step = lattice.shortestStepMm();
    const glm::dvec3 u = step * glm::normalize(glm::cross(normal, aside));
    const Frame own = frameOf(contours.front().front(), u, glm::cross(normal, u), normal);
    if (!areAlong(contours, own))
        fail(because::contoursNotPlanar);
    return own;
}

using Polygon = std::vector<glm::dvec2>; ///< in pixels

struct PolygonsOfPlane {
    double atMm = 0.0;
    std::vector<Polygon> polygons;
};

// Contours at about the same position are in one plane.
std::vector<PolygonsOfPlane> byPlane(const std::vector<std::span<const glm::dvec3>> &contours,
                                     const Frame &frame) {
    std::vector<std::pair<double, Polygon>> all;
    for (const auto &contour : contours) {
        double at = 0.0;
        Polygon polygon;
        for (const glm::dvec3 &point : contour) {
            const glm::dvec3 p = frame.toPixels * (point - frame.origin);
            polygon.emplace_back(p.x, p.y);
            at += p.z / double(contour.size());
        }
        all.emplace_back(at, std::move(polygon));
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<PolygonsOfPlane> planes;
    for (auto &[at, polygon] : all) {
        if (planes.empty() || at - planes.back().atMm > flatnessMm)
            planes.push_back({at, {}});
        planes.back().polygons.push_back(std::move(polygon));
    }
    return planes;
}

// Coordinates are decimal numbers: half of the last place that they use. Places below 0.001 mm do
// not matter.
double roundingMm(const std::vector<std::span<const glm::dvec3>> &contours) {
    for (const double place : {0.1, 0.01, 0.001}) {
        const auto uses = [&](const glm::dvec3 &point) {
            const glm::dvec3 places = point / place;
            return glm::compMax(glm::abs(places - glm::round(places))) < 1e-6;
        };
        if (std::all_of(contours.begin(), contours.end(), [&](const auto &contour) {
                return std::all_of(contour.begin(), contour.end(), uses);
            }))
            return 0.5 * place;
    }
    return 0.0;
}

// Moves planes onto the slices from which only rounding separates them. Returns the largest
// distance of the others within the volume from a slice.
double moveOntoSlices(std::vector<PolygonsOfPlane> &planes, const Lattice &lattice,
                      double roundedMm) {
    // A slice may have a negative position along the columns' and rows' normal.
    const double stepMm = glm::dot(lattice.step(2), lattice.sliceNormal());
    constexpr double exactMm = 1e-6;
    const double near = std::max(sampleTolerance * lattice.sliceDistanceMm(), roundedMm + exactMm);
    double farthest = 0.0;
    for (PolygonsOfPlane &plane : planes) {
        const double slice = std::round(plane.atMm / stepMm);
        const double off = std::abs(plane.atMm - slice * stepMm);
        if (off <= near)
            plane.atMm = slice * stepMm;
        else if (slice >= 0.0 && slice < lattice.size().k)
            farthest = std::max(farthest, off);
    }
    return farthest;
}

// Adds the length of [from, to] within each pixel of a row; pixel c reaches from c - 1/2 to c +
// 1/2.
void addSpan(double from, double to, std::span<double> row) {
    const double low = std::max(from + 0.5, 0.0), high = std::min(to + 0.5, double(row.size()));
    for (auto c = std::size_t(low); double(c) < high; ++c)
        row[c] += std::min(high, double(c) + 1.0) - std::max(low, double(c));
}

struct Edge {
    glm::dvec2 from, to;
};

// The edges of polygons by the rows that they cross, so that a line looks at few of them.
std::vector<std::vector<Edge>> edgesByRow(const std::vector<Polygon> &polygons, int firstRow,
                                          int rows) {
    std::vector<std::vector<Edge>> edges(std::size_t(rows), std::vector<Edge>{});
    for (const Polygon &polygon : polygons)
        for (std::size_t n = 0; n < polygon.size(); ++n) {
            const glm::dvec2 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
            const double low = std::floor(std::min(a.y, b.y) + 0.5) - firstRow,
                         high = std::floor(std::max(a.y, b.y) + 0.5) - firstRow;
            for (int row = int(std::max(low, 0.0)); row <= int(std::min(high, rows - 1.0)); ++row)
                edges[std::size_t(row)].push_back({a, b});
        }
    return edges;
}

// Fills the area that an odd number of polygons encloses.
void fill(const std::vector<Polygon> &polygons, glm::ivec2 origin, int columns, int rows,
          std::uint16_t *to, const task::Progress &progress) {
    std::vector<double> row(std::size_t(columns), 0.0), crossings;
    const auto edges = edgesByRow(polygons, origin.y, rows);
    for (int r = 0; r < rows; ++r) {
        progress.check();
        std::fill(row.begin(), row.end(), 0.0);
        for (int line = 0; line < linesPerPixel; ++line) {
            const double y = origin.y + r - 0.5 + (line + 0.5) / linesPerPixel;
            crossings.clear();
            for (const Edge &edge : edges[std::size_t(r)])
                if ((edge.from.y <= y) != (edge.to.y <= y))
                    crossings.push_back(edge.from.x +
                                        (y - edge.from.y) / (edge.to.y - edge.from.y) *
                                            (edge.to.x - edge.from.x) -
                                        origin.x);
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
                addSpan(crossings[n], crossings[n + 1], row);
        }
        for (int c = 0; c < columns; ++c)
            to[std::size_t(r) * std::size_t(columns) + std::size_t(c)] = std::uint16_t(
                std::lround(row[std::size_t(c)] / linesPerPixel * volume::Coverage::whole));
    }
}

// The pixels that the polygons reach. Contours of more are damaged.
struct Extent {
    glm::ivec2 low, high;
};

Extent extentOf(const std::vector<PolygonsOfPlane> &planes) {
    constexpr double largest = 65535.0;
    glm::dvec2 low{1e30}, high{-1e30};
    for (const PolygonsOfPlane &plane : planes)
        for (const Polygon &polygon : plane.polygons)
            for (const glm::dvec2 &p : polygon) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
    low = glm::floor(low + 0.5);
    high = glm::floor(high + 0.5);
    if (std::max(high.x - low.x, high.y - low.y) >= largest ||
        std::max(glm::length(low), glm::length(high)) > 1e8)
        fail(because::contoursTooLarge);
    return {glm::ivec2(low), glm::ivec2(high)};
}

} // namespace

FilledContours filled(const std::vector<std::span<const glm::dvec3>> &contours,
                      const Lattice &lattice, const task::Progress &progress) {
    const Frame slices = frameOfSlices(lattice);
    const bool areAlongSlices = areAlong(contours, slices);
    const Frame frame = areAlongSlices ? slices : ownFrame(contours, lattice);
    std::vector<PolygonsOfPlane> planes = byPlane(contours, frame);
    FilledContours result;
    if (areAlongSlices)
        result.betweenSlicesMm = moveOntoSlices(planes, lattice, roundingMm(contours));
    const Extent extent = extentOf(planes);
    StoredMasks &masks = result.masks;
    masks.kind = StoredMasks::Pixels::fractions;
    masks.longestGap = 2.5; // some programs leave out a slice between drawn ones
    if (planes.size() == 1) // nothing else says how thick it is
        masks.thicknessMm = lattice.sliceDistanceMm();
    masks.columns = extent.high.x - extent.low.x + 1;
    masks.rows = extent.high.y - extent.low.y + 1;
    const std::size_t pixels = std::size_t(masks.columns) * std::size_t(masks.rows);
    return task::orOutOfMemory(because::noMemoryForTheSegments, [&] {
        system::requireMemory(double(pixels) * double(planes.size()) * sizeof(std::uint16_t));
        result.fractions.resize(pixels * planes.size());
        for (const PolygonsOfPlane &plane : planes)
            masks.planes.push_back({frame.origin + frame.steps[0] * double(extent.low.x) +
                                        frame.steps[1] * double(extent.low.y) +
                                        frame.steps[2] * plane.atMm,
                                    frame.steps[0], frame.steps[1], 0});
        tbb::parallel_for(std::size_t(0), planes.size(), [&](std::size_t n) {
            progress.check();
            fill(planes[n].polygons, extent.low, masks.columns, masks.rows,
                 result.fractions.data() + n * pixels, progress);
        });
        masks.pixels = std::as_bytes(std::span(result.fractions));
        return std::move(result);
    });
}

} // namespace pellucid::segment
