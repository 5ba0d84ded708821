// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/energy_marginals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace pellucid::render {

namespace {

// The field is cut into at most so many blocks along an axis; each is worked on alone.
constexpr int blocksAlong = 64;
// Distances from the centre are told apart to the radius over this.
constexpr int distanceSteps = 64;

// A projection along an axis of the lattice.
struct AxisProjection {
    std::vector<double> sums;
    int columns, rows;
    double columnMm, rowMm;

    // Its means over pixels of a size, or the samples where those are larger.
    AxisProjection inPixels(double pixelMm) const {
        const int across = std::max(1, int(std::lround(pixelMm / columnMm)));
        const int down = std::max(1, int(std::lround(pixelMm / rowMm)));
        if (across == 1 && down == 1)
            return *this;
        AxisProjection coarse{{}, (columns + across - 1) / across, (rows + down - 1) / down, 1, 1};
        coarse.sums.resize(std::size_t(coarse.columns) * coarse.rows);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                coarse.sums[std::size_t(row / down) * coarse.columns + column / across] +=
                    sums[std::size_t(row) * columns + column];
        return coarse;
    }

    double roughness() const {
        const auto at = [&](int column, int row) {
            return column < 0 || row < 0 || column >= columns || row >= rows
                       ? 0.0
                       : sums[std::size_t(row) * columns + column];
        };
        double differences = 0.0, energy = 0.0;
        for (int row = 0; row <= rows; ++row)
            for (int column = 0; column <= columns; ++column) {
                const double here = at(column, row), across = here - at(column - 1, row),
                             down = here - at(column, row - 1);
                energy += here * here;
                differences += across * across + down * down;
            }
        return energy > 0.0 ? std::min(1.0, differences / (4.0 * energy)) : 1.0;
    }
};

// A quarter of the surface of the box, or of the sphere where that is smaller.
double shadowOf(const volume::Lattice &lattice, const volume::VoxelBox &box, double radiusMm) {
    const volume::GridSize size = box.size();
    const double i = size.i * lattice.spacingMm(0), j = size.j * lattice.spacingMm(1),
                 k = size.k * lattice.spacingMm(2);
    // A sample is as wide as a step.
    const double reach = radiusMm + 0.5 * std::max({lattice.spacingMm(0), lattice.spacingMm(1),
                                                    lattice.spacingMm(2)});
    return std::min(0.5 * (i * j + j * k + k * i), std::numbers::pi * reach * reach);
}

// What the samples of one layer of blocks, a few planes k, add up to.
struct Layer {
    std::vector<double> alongI, alongJ; // energies
    std::vector<double> blocks;         // energies, [block along j][block along i]
    double radiusMm = 0.0;
};

// Thirteen directions that no view is far from.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> result;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0))))
                    result.push_back(glm::normalize(glm::dvec3(x, y, z)));
    return result;
}

// Adds up shares of energy by their distance along each direction.
class DistanceProfiles {
public:
    explicit DistanceProfiles(EnergySpread &spread) : m_spread(spread) {
        m_spread.byDistance.assign(m_directions.size(), std::vector<double>(distanceSteps));
        m_spread.distanceStepMm = std::max(spread.radiusMm, 1e-300) / distanceSteps;
        m_spread.concentration = 0.0;
    }
    void add(const glm::dvec3 &fromCenterMm, double share) {
        m_spread.concentration += share * share;
        for (std::size_t d = 0; d < m_directions.size(); ++d) {
            const double steps =
                std::abs(glm::dot(fromCenterMm, m_directions[d])) / m_spread.distanceStepMm;
            // Middles of blocks may lie beyond the outermost samples.
            m_spread.byDistance[d][std::size_t(std::min(steps, distanceSteps - 1.0))] += share;
        }
    }

private:
    EnergySpread &m_spread;
    std::vector<glm::dvec3> m_directions = directions();
};

} // namespace

double EnergySpread::roughnessAt(double pixelMm) const {
    const double scale =
        std::clamp(std::log2(pixelMm / shortestStepMm), 0.0, double(roughness.size() - 1));
    return std::max(roughness[std::size_t(std::floor(scale))],
                    roughness[std::size_t(std::ceil(scale))]);
}

EnergySpread evenSpread(const volume::Lattice &lattice, const volume::VoxelBox &box) {
    const glm::dvec3 center = lattice.center().mm;
    const volume::GridSize size = box.size();
    const auto at = [&](double i, double j, double k) {
        return lattice
                   .patient(
                       volume::VoxelPoint{{box.lo.i + i * (size.i - 1), box.lo.j + j * (size.j - 1),
                                           box.lo.k + k * (size.k - 1)}})
                   .mm -
               center;
    };
    EnergySpread spread;
    spread.shortestStepMm = lattice.shortestStepMm();
    for (const double i : {0.0, 1.0})
        for (const double j : {0.0, 1.0})
            for (const double k : {0.0, 1.0})
                spread.radiusMm = std::max(spread.radiusMm, glm::length(at(i, j, k)));
    spread.shadowMm2 = shadowOf(lattice, box, spread.radiusMm);
    constexpr int parts = 16;
    DistanceProfiles profiles(spread);
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j)
            for (int k = 0; k < parts; ++k)
                profiles.add(at((i + 0.5) / parts, (j + 0.5) / parts, (k + 0.5) / parts),
                             1.0 / (parts * parts * parts));
    return spread;
}

EnergyMarginals energyMarginals(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::Lattice &places = field.lattice();
    const volume::GridSize lattice = places.size(), size = box.size();
    const glm::dvec3 center = places.center().mm;
    const int side = (std::max({size.i, size.j, size.k}) + blocksAlong - 1) / blocksAlong;
    const auto blocksOf = [side](int samples) { return (samples + side - 1) / side; };
    const int across = blocksOf(size.i), down = blocksOf(size.j);
    const auto rowStart = [&](int j, int k) {
        return (std::size_t(k + box.lo.k) * lattice.j + j + box.lo.j) * lattice.i + box.lo.i;
    };

    EnergyMarginals result;
    EnergySpread spread;
    result.axis[2].resize(size.k);
    std::vector<double> alongX(std::size_t(size.j) * size.k), alongY(std::size_t(size.i) * size.k),
        alongZ(std::size_t(size.i) * size.j);
    std::vector<Layer> layers(blocksOf(size.k));
    field.visit([&](auto samples) {
        tbb::parallel_for(std::size_t(0), layers.size(), [&](std::size_t n) {
            Layer &layer = layers[n];
            layer.alongI.resize(size.i);
            layer.alongJ.resize(size.j);
            layer.blocks.resize(std::size_t(across) * down);
            for (int k = int(n) * side; k < std::min(size.k, int(n + 1) * side); ++k)
                for (int j = 0; j < size.j; ++j) {
                    const auto *const row = samples.data() + rowStart(j, k);
                    double inRow = 0.0, rowSum = 0.0;
                    int first = size.i, last = -1;
                    for (int i = 0; i < size.i; ++i) {
                        const double f = double(row[i]);
                        layer.alongI[i] += f * f;
                        rowSum += f;
                        alongY[std::size_t(k) * size.i + i] += f;
                        if (f != 0.0) {
                            first = std::min(first, i);
                            last = i;
                        }
                    }
                    for (int block = 0; block < across; ++block) {
                        double inBlock = 0.0;
                        for (int i = block * side; i < std::min(size.i, (block + 1) * side); ++i)
                            inBlock += double(row[i]) * double(row[i]);
                        layer.blocks[std::size_t(j / side) * across + block] += inBlock;
                        inRow += inBlock;
                    }
                    for (const int end : {first, last})
                        if (last >= 0) {
                            const volume::VoxelIndex at{end + box.lo.i, j + box.lo.j, k + box.lo.k};
                            layer.radiusMm = std::max(layer.radiusMm,
                                                      glm::distance(center, places.patient(at).mm));
                        }
                    alongX[std::size_t(k) * size.j + j] = rowSum;
                    layer.alongJ[j] += inRow;
                    result.axis[2][k] += inRow;
                }
        });
        tbb::parallel_for(0, size.j, [&](int j) {
            for (int k = 0; k < size.k; ++k)
                for (int i = 0; i < size.i; ++i)
                    alongZ[std::size_t(j) * size.i + i] += double(samples[rowStart(j, k) + i]);
        });
    });
    spread.shortestStepMm = places.shortestStepMm();
    const double i = places.spacingMm(0), j = places.spacingMm(1), k = places.spacingMm(2);
    const std::array<AxisProjection, 3> projections{
        AxisProjection{std::move(alongX), size.j, size.k, j, k},
        AxisProjection{std::move(alongY), size.i, size.k, i, k},
        AxisProjection{std::move(alongZ), size.i, size.j, i, j}};
    for (std::size_t scale = 0; scale < spread.roughness.size(); ++scale) {
        spread.roughness[scale] = 0.0;
        for (const AxisProjection &projection : projections)
            spread.roughness[scale] = std::max(
                spread.roughness[scale],
                projection.inPixels(std::ldexp(spread.shortestStepMm, int(scale))).roughness());
    }

    // Layers are added in their order: the same sums for any number of threads.
    double total = 0.0;
    result.axis[0].resize(size.i);
    result.axis[1].resize(size.j);
    for (const Layer &layer : layers) {
        std::transform(layer.alongI.begin(), layer.alongI.end(), result.axis[0].begin(),
                       result.axis[0].begin(), std::plus<>());
        std::transform(layer.alongJ.begin(), layer.alongJ.end(), result.axis[1].begin(),
                       result.axis[1].begin(), std::plus<>());
        for (const double e : layer.blocks)
            total += e;
        spread.radiusMm = std::max(spread.radiusMm, layer.radiusMm);
    }
    spread.shadowMm2 = shadowOf(places, box, spread.radiusMm);
    DistanceProfiles profiles(spread);
    if (total > 0.0)
        for (auto &axis : result.axis)
            for (double &e : axis)
                e /= total;
    for (std::size_t n = 0; n < layers.size(); ++n)
        for (int row = 0; row < down; ++row)
            for (int column = 0; column < across; ++column) {
                const double energy = layers[n].blocks[std::size_t(row) * across + column];
                if (energy == 0.0)
                    continue;
                const auto middle = [side](int block, int samples) {
                    return 0.5 * (block * side + std::min(samples, (block + 1) * side) - 1);
                };
                const volume::VoxelPoint at{{box.lo.i + middle(column, size.i),
                                             box.lo.j + middle(row, size.j),
                                             box.lo.k + middle(int(n), size.k)}};
                profiles.add(places.patient(at).mm - center, energy / total);
            }
    result.spread = std::make_shared<const EnergySpread>(std::move(spread));
    return result;
}

} // namespace pellucid::render
