// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/least_projection_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace pellucid::field {

namespace {

constexpr int views = 64;
constexpr int maxPixels = 128; // along a side of a coarse projection

// Between the sampled directions the energy does not fall below this share of the minimum found:
// aligned parts make narrow peaks in the energy, not narrow valleys.
constexpr double sampledShare = 0.85;

// Directions that cover half a sphere evenly, along a spiral.
glm::dvec3 viewDirection(int view) {
    const double z = (view + 0.5) / views, angle = view * std::numbers::pi * (3.0 - std::sqrt(5.0)),
                 r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

// The masses of a field as points.
struct PointMasses {
    std::vector<glm::dvec3> placesMm; ///< relative to the middle of the box
    std::vector<double> masses;
    double radiusMm = 0.0; ///< the largest distance of a point
    double blockMm = 0.0;  ///< the longest side of a block
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
        points.placesMm.push_back(lattice.patient(volume::VoxelPoint{at}).mm - middle);
        points.masses.push_back(double(block.mass));
        points.radiusMm = std::max(points.radiusMm, glm::length(points.placesMm.back()));
    }
    return points;
}

// The energy of the projection along w, each mass shared between the nearest four pixels. *Shape*:
// side x side pixels.
double projectionEnergy(const PointMasses &points, const glm::dvec3 &w, double pixelMm, int side) {
    const glm::dvec3 u = glm::normalize(glm::cross(w, glm::dvec3(0.0, 1.0, 0.0))),
                     v = glm::cross(w, u);
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
    const PointMasses points = pointMasses(blocks, lattice, box);
    const double pixelMm = std::max(points.blockMm, 2.0 * points.radiusMm / (maxPixels - 3));
    const int side = int(2.0 * points.radiusMm / pixelMm) + 3;
    std::array<double, views> energies{};
    tbb::parallel_for(0, views, [&](int view) {
        energies[std::size_t(view)] = projectionEnergy(points, viewDirection(view), pixelMm, side);
    });
    return sampledShare * *std::min_element(energies.begin(), energies.end());
}

} // namespace pellucid::field
