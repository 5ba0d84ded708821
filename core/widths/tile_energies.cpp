// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/widths/tile_energies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::widths {

namespace {

// The factor is tabled to so many cycles; beyond, it stays below its largest value there.
constexpr int perCycle = 128, tabledCycles = 4;

// The points of a tile, 4 x 4 from edge to edge.
BlockEnergies::Points pointsOf(const SlicePlane &plane) {
    constexpr int along = 4;
    static_assert(along * along == BlockEnergies::pointCount);
    BlockEnergies::Points points;
    for (std::size_t d = 0; d < 3; ++d)
        for (int n = 0; n < BlockEnergies::pointCount; ++n) {
            const double column = double(n % along) / (along - 1) * SliceTiles::columns - 0.5,
                         row = double(n / along) / (along - 1) * SliceTiles::rows - 0.5; // NOLINT
            points.cells[d][std::size_t(n)] =
                float(column * plane.perColumn[d] + row * plane.perRow[d]);
        }
    return points;
}

} // namespace

FactorBounds::FactorBounds(const scene::ImageDefinition &image)
    : m_bounds(std::size_t(tabledCycles * perCycle) + 1, 0.0F) {
    constexpr int finer = 8;
    float largest = 0.0F;
    // The lobe beyond the table is larger than those that follow.
    for (int n = (int(m_bounds.size()) + perCycle) * finer; n-- > 0;) {
        const double factor = scene::reconstructionFactor(image, n / (double(perCycle) * finer));
        largest = std::max(largest, float(factor * factor));
        if (const auto at = std::size_t(n / finer); at < m_bounds.size())
            m_bounds[at] = largest;
    }
}

double FactorBounds::beyond(double cycles) const {
    return m_bounds[std::min(m_bounds.size() - 1, std::size_t(std::max(0.0, cycles) * perCycle))];
}

std::vector<float> tileEnergies(const SlicePlane &plane, const SliceTiles &tiles,
                                std::span<const SliceSource> sources, const FactorBounds &factors,
                                const ForEach &forEach) {
    const BlockEnergies::Points points = pointsOf(plane);
    const auto energyOf = [&](int strip, int tile) {
        double energy = 0.0;
        for (const SliceSource &source : sources) {
            std::array<double, 3> first{};
            double factor = 1.0, weight = source.factor;
            for (std::size_t d = 0; d < 3; ++d) {
                const double padded = source.energies->padded()[int(d)];
                const double column = plane.perColumn[d] * SliceTiles::columns,
                             row = plane.perRow[d] * SliceTiles::rows;
                first[d] = strip * column + tile * row;
                const double middle = (first[d] + 0.5 * (column + row)) / padded,
                             reach = 0.5 * (std::abs(column) + std::abs(row)) / padded;
                factor *= factors.beyond(std::abs(middle) - reach);
                first[d] += source.offset[d];
                if (source.perSine[d] > 0.0) {
                    const double turn = 2.0 * std::numbers::pi,
                                 sine = std::abs(
                                     std::sin(turn * (middle + source.offset[d] / padded)));
                    const double most = std::min(1.0, sine + turn * reach);
                    weight += source.perSine[d] * most * most;
                }
            }
            energy += weight * factor * double(source.energies->mean(first, points));
        }
        return float(energy);
    };
    std::vector<float> energies(tiles.count(), 0.0F);
    forEach(tiles.strips, [&](int strip) {
        const int side = tiles.sides[std::size_t(strip)];
        for (int tile = -side; tile < side; ++tile)
            energies[tiles.at(strip, tile)] = energyOf(strip, tile);
    });
    return energies;
}

} // namespace pellucid::widths
