// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mpr/box_outline.h"

namespace pellucid::mpr {

namespace {

// So that a face exactly at the picture's border counts as a face despite rounding. *Units*:
// pixels.
constexpr double margin = 2.0;

// A corner of the outline, and the face of the edge after it.
struct Corner {
    glm::dvec2 at{0.0};
    int axis = -1;
    bool isHigh = false;
};

// Keeps the part where value >= 0; `value` is linear over the picture. *Source*: Sutherland and
// Hodgman 1974, one side of the clipping.
template <class Value>
std::vector<Corner> clipped(const std::vector<Corner> &outline, int axis, bool isHigh,
                            const Value &value) {
    std::vector<Corner> kept;
    for (std::size_t n = 0; n < outline.size(); ++n) {
        const Corner &from = outline[n], &to = outline[(n + 1) % outline.size()];
        const double a = value(from.at), b = value(to.at);
        const auto crossing = [&] { return from.at + (to.at - from.at) * (a / (a - b)); };
        if (a >= 0.0) {
            kept.push_back(from);
            if (b < 0.0) // the edge along the face starts
                kept.push_back({crossing(), axis, isHigh});
        } else if (b >= 0.0) {
            kept.push_back({crossing(), from.axis, from.isHigh});
        }
    }
    return kept;
}

} // namespace

std::vector<BoxEdge> boxOutline(const volume::Lattice &lattice, const LatticeBox &box,
                                const Plane &plane) {
    // Voxel coordinates are linear over the picture.
    const glm::dvec3 origin = lattice.voxel(plane.at(0.0, 0.0)).v;
    const glm::dvec3 perColumn = lattice.voxel(plane.at(1.0, 0.0)).v - origin;
    const glm::dvec3 perRow = lattice.voxel(plane.at(0.0, 1.0)).v - origin;
    const double left = -0.5 - margin, right = plane.width - 0.5 + margin,
                 bottom = plane.height - 0.5 + margin;
    std::vector<Corner> outline{
        {{left, left}}, {{right, left}}, {{right, bottom}}, {{left, bottom}}};
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](const glm::dvec2 &p) {
            return origin[axis] + p.x * perColumn[axis] + p.y * perRow[axis];
        };
        outline = clipped(outline, axis, false,
                          [&](const glm::dvec2 &p) { return at(p) - box.low[axis]; });
        outline = clipped(outline, axis, true,
                          [&](const glm::dvec2 &p) { return box.high[axis] - at(p); });
    }
    std::vector<BoxEdge> edges;
    for (std::size_t n = 0; n < outline.size(); ++n)
        edges.push_back({outline[n].at, outline[(n + 1) % outline.size()].at, outline[n].axis,
                         outline[n].isHigh});
    return edges;
}

} // namespace pellucid::mpr
