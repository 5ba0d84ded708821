// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/least_projection_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace pellucid::field {

namespace {

constexpr int views = 64;
constexpr int maxPixels = 128;      // along a side of a coarse projection
constexpr int descents = 4;         // from the least of the views
constexpr double finestTurn = 0.01; // radians: a pixel at the edge of such a projection

// Directions that cover half a sphere evenly, along a spiral.
glm::dvec3 viewDirection(int view) {
    const double z = (view + 0.5) / views, angle = view * std::numbers::pi * (3.0 - std::sqrt(5.0)),
                 r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

// A direction at right angles to w.
glm::dvec3 across(const glm::dvec3 &w) {
    return glm::normalize(
        glm::cross(w, std::abs(w.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0)));
}

// The masses of a field as points.
struct PointMasses {
    std::vector<glm::dvec3> placesMm; ///< relative to the middle of the box
    std::vector<double> masses;
    double radiusMm = 0.0; ///< the largest distance of a point
    double blockMm = 0.0;  ///< the longest side of a block

    void add(const glm::dvec3 &placeMm, double mass) {
        placesMm.push_back(placeMm);
        masses.push_back(mass);
        radiusMm = std::max(radiusMm, glm::length(placeMm));
    }
};

PointMasses pointMasses(std::span<const Block> blocks, const volume::Lattice &lattice,
                        const volume::VoxelBox &box) {
    const volume::GridSize size = box.size();
    PointMasses points;
    std::array<std::vector<BlockRange>, 3> ranges;
    for (int d = 0; d < 3; ++d) {
        ranges[std::size_t(d)] = blockRanges(size[d]);
        points.blockMm = std::max(points.blockMm, lattice.spacingMm(d) * size[d] /
                                                      double(ranges[std::size_t(d)].size()));
    }
    const glm::dvec3 middle =
        lattice
            .patient(volume::VoxelPoint{0.5 * (glm::dvec3(box.lo.i, box.lo.j, box.lo.k) +
                                               glm::dvec3(box.hi.i, box.hi.j, box.hi.k) - 1.0)})
            .mm;
    for (const Block &block : blocks) {
        glm::dvec3 at(box.lo.i, box.lo.j, box.lo.k);
        for (int d = 0; d < 3; ++d) {
            const BlockRange &range = ranges[std::size_t(d)][block.at[std::size_t(d)]];
            at[d] += 0.5 * (range.first + range.last);
        }
        points.add(lattice.patient(volume::VoxelPoint{at}).mm - middle, double(block.mass));
    }
    return points;
}

// The same with the points of four blocks a side joined.
PointMasses joined(const PointMasses &fine) {
    const double cellMm = 4.0 * fine.blockMm;
    const int side = int(2.0 * fine.radiusMm / cellMm) + 1;
    struct Cell {
        glm::dvec3 momentMm{0.0};
        double mass = 0.0;
    };
    std::vector<Cell> cells(std::size_t(side) * std::size_t(side) * std::size_t(side));
    for (std::size_t n = 0; n < fine.masses.size(); ++n) {
        const glm::ivec3 at((fine.placesMm[n] + fine.radiusMm) / cellMm);
        Cell &cell = cells[std::size_t((at.z * side + at.y) * side + at.x)];
        cell.momentMm += fine.masses[n] * fine.placesMm[n];
        cell.mass += fine.masses[n];
    }
    PointMasses points;
    points.blockMm = cellMm;
    for (const Cell &cell : cells)
        if (cell.mass > 0.0)
            points.add(cell.momentMm / cell.mass, cell.mass);
    return points;
}

// The energy of the projection along w, each mass shared between the nearest four pixels.
double projectionEnergy(const PointMasses &points, const glm::dvec3 &w) {
    const double pixelMm = std::max(points.blockMm, 2.0 * points.radiusMm / (maxPixels - 3));
    const int side = int(2.0 * points.radiusMm / pixelMm) + 3;
    const glm::dvec3 u = across(w), v = glm::cross(w, u);
    std::vector<double> picture(std::size_t(side) * std::size_t(side));
    for (std::size_t n = 0; n < points.masses.size(); ++n) {
        const double x = glm::dot(points.placesMm[n], u) / pixelMm + 0.5 * (side - 1),
                     y = glm::dot(points.placesMm[n], v) / pixelMm + 0.5 * (side - 1);
        const double column = std::floor(x), row = std::floor(y), right = x - column,
                     down = y - row, mass = points.masses[n];
        double *const at =
            picture.data() + std::size_t(row) * std::size_t(side) + std::size_t(column);
        at[0] += mass * (1.0 - right) * (1.0 - down);
        at[1] += mass * right * (1.0 - down);
        at[side] += mass * (1.0 - right) * down;
        at[side + 1] += mass * right * down;
    }
    double energy = 0.0;
    for (const double sum : picture)
        energy += sum * sum / (pixelMm * pixelMm);
    return energy;
}

// Descends from w by ever smaller turns. Returns the direction of the least energy found.
glm::dvec3 downhill(const PointMasses &points, glm::dvec3 w, double energy) {
    constexpr int ways = 6;
    for (double turn = 1.0 / std::sqrt(double(views)); turn > finestTurn;) {
        const glm::dvec3 from = w, u = across(w), v = glm::cross(w, u);
        for (int way = 0; way < ways; ++way) {
            const double angle = 2.0 * std::numbers::pi * way / ways;
            const glm::dvec3 turned =
                glm::normalize(from + turn * (std::cos(angle) * u + std::sin(angle) * v));
            if (const double found = projectionEnergy(points, turned); found < energy) {
                energy = found;
                w = turned;
            }
        }
        if (w == from)
            turn *= 0.5;
    }
    return w;
}

} // namespace

void MassInBalls::add(const glm::dvec3 &middleMm, double share) {
    m_blocks.push_back({middleMm, share});
    m_center += share * middleMm;
}

double MassInBalls::minArea(double halfMm) const {
    double radius = 0.0;
    for (const Block &block : m_blocks)
        radius = std::max(radius, glm::distance(block.middleMm, m_center) + halfMm);
    constexpr int bins = 64;
    const double binMm = radius / bins;
    std::array<double, bins> within{};
    for (const Block &block : m_blocks) {
        const double mm = glm::distance(block.middleMm, m_center) + halfMm;
        within[std::size_t(std::min(bins - 1, int(mm / binMm)))] += block.share;
    }
    double share = 0.0, least = std::numeric_limits<double>::infinity();
    for (int bin = 0; bin < bins; ++bin) {
        share += within[std::size_t(bin)];
        const double r = (bin + 1) * binMm;
        if (share > 0.0)
            least = std::min(least, std::numbers::pi * r * r / (share * share));
    }
    return least;
}

double leastProjectionEnergy(std::span<const Block> blocks, const volume::Lattice &lattice,
                             const volume::VoxelBox &box) {
    const PointMasses points = pointMasses(blocks, lattice, box), coarse = joined(points);
    std::array<double, views> energies{};
    tbb::parallel_for(0, views, [&](int view) {
        energies[std::size_t(view)] = projectionEnergy(coarse, viewDirection(view));
    });
    std::array<int, views> order{};
    std::iota(order.begin(), order.end(), 0);
    std::partial_sort(order.begin(), order.begin() + descents, order.end(), [&](int a, int b) {
        return energies[std::size_t(a)] < energies[std::size_t(b)];
    });
    std::array<double, descents> least{};
    tbb::parallel_for(0, descents, [&](int n) {
        const int view = order[std::size_t(n)];
        least[std::size_t(n)] = projectionEnergy(
            points, downhill(coarse, viewDirection(view), energies[std::size_t(view)]));
    });
    return *std::min_element(least.begin(), least.end());
}

} // namespace pellucid::field
