// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/field/energy_marginals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/field/least_projection_energy.h"
#include "core/field/line_integral_bound.h"
#include "core/field/row_sums.h"

namespace pellucid::field {

namespace {

// The largest number of blocks along an axis; layers of blocks are processed independently.
constexpr int blocksAlong = 64;
// The number of bins for distances from the centre, up to the radius.
constexpr int distanceSteps = 64;

// A quarter of the surface of the box, or of the enclosing sphere if that is smaller.
double shadowOf(const volume::Lattice &lattice, const volume::VoxelBox &box, double radiusMm) {
    const volume::GridSize size = box.size();
    const double i = size.i * lattice.spacingMm(0), j = size.j * lattice.spacingMm(1),
                 k = size.k * lattice.spacingMm(2);
    // A sample is as wide as a step, so it extends half a step beyond its centre.
    const double reach = radiusMm + 0.5 * lattice.longestStepMm();
    return std::min(0.5 * (i * j + j * k + k * i), std::numbers::pi * reach * reach);
}

// Thirteen directions, one of them close to any view.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> result;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0))))
                    result.push_back(glm::normalize(glm::dvec3(x, y, z)));
    return result;
}

// Histograms of the energy shares by distance along each direction.
class DistanceProfiles {
public:
    explicit DistanceProfiles(EnergySpread &spread) : m_spread(spread) {
        m_spread.byDistance.assign(m_directions.size(), std::vector<double>(distanceSteps));
        m_spread.distanceStepMm = std::max(spread.radiusMm, 1e-300) / distanceSteps;
    }
    void add(const glm::dvec3 &fromCenterMm, double share) {
        for (std::size_t d = 0; d < m_directions.size(); ++d) {
            const double steps =
                std::abs(glm::dot(fromCenterMm, m_directions[d])) / m_spread.distanceStepMm;
            // The middle of a block may be farther out than the outermost nonzero sample.
            m_spread.byDistance[d][std::size_t(std::min(steps, distanceSteps - 1.0))] += share;
        }
    }

private:
    EnergySpread &m_spread;
    std::vector<glm::dvec3> m_directions = directions();
};

// The statistics of a field, from sums over layers of cubic blocks. Layers are summed in parallel
// and joined in order: the sums do not depend on the number of threads.
class FieldStatistics {
public:
    FieldStatistics(const volume::Field &field, const volume::VoxelBox &box)
        : m_field(field), m_lattice(field.lattice()), m_box(box), m_size(box.size()),
          m_center(m_lattice.center().mm),
          m_side((std::max({m_size.i, m_size.j, m_size.k}) + blocksAlong - 1) / blocksAlong),
          m_across(blocksOf(m_size.i)), m_down(blocksOf(m_size.j)), m_layers(blocksOf(m_size.k)) {
        for (int d = 0; d < 3; ++d) {
            LayerMaxima &maxima = m_maxima[std::size_t(d)];
            maxima.samples = m_size[d];
            maxima.columns = blocksOf(m_size[(d + 1) % 3]);
            maxima.rows = blocksOf(m_size[(d + 2) % 3]);
            maxima.values.resize(std::size_t(maxima.samples) * std::size_t(maxima.columns) *
                                 std::size_t(maxima.rows));
            m_result.axis[std::size_t(d)].resize(std::size_t(m_size[d]));
        }
        for (std::size_t d = 0; d < 3; ++d) {
            m_ranges[d] = blockRanges(m_size[int(d)]);
            for (std::size_t n = 0; n < m_ranges[d].size(); ++n)
                m_blockAt[d].resize(std::size_t(m_ranges[d][n].last) + 1, n);
        }
        m_spread.shortestStepMm = m_lattice.shortestStepMm();
        m_spread.longestStepMm = m_lattice.longestStepMm();
    }

    EnergyMarginals marginals() {
        tbb::parallel_for(std::size_t(0), m_layers.size(),
                          [&](std::size_t n) { sumLayer(int(n)); });
        joinLayers();
        m_isPositive = isPositive();
        m_spread.shadowMm2 = shadowOf(m_lattice, m_box, m_spread.radiusMm);
        const MassInBalls balls = profileBlocks();
        m_result.massMm3 = m_mass * m_lattice.cellVolumeMm3();
        m_result.energyMm3 = m_energy * m_lattice.cellVolumeMm3();
        m_spread.roughestView = m_roughness;
        if (m_isPositive)
            boundAnyView(balls);
        m_result.spread = std::make_shared<const EnergySpread>(std::move(m_spread));
        return std::move(m_result);
    }

private:
    // Sums and extremes of the samples of one layer of blocks, which is a few planes k.
    struct Layer {
        std::vector<double> alongI, alongJ; // energies
        std::vector<double> blocks;         // energies, [block along j][block along i]
        std::vector<double> blockMass;
        // The blocks of `blockRanges`, plane by plane: [plane][block along j][block along i].
        std::vector<double> partEnergy, partMass;
        double differences = 0.0; // squares of the second differences along all axes
        double least = 0.0;
        double radiusMm = 0.0;
    };

    // Sums and maxima over the rows of a block, by sample along i; the loops become vector code. A
    // block has few rows, 64 for 512 samples and 1024 for 2048: floats round their sum by less than
    // 1e-4 of the sum of magnitudes.
    struct RowSums {
        explicit RowSums(int samples)
            : energy(std::size_t(samples)), mass(energy.size()), maxima(energy.size()) {}
        void clear() {
            for (std::vector<float> *const each : {&energy, &mass, &maxima})
                std::fill(each->begin(), each->end(), 0.0F);
        }
        std::vector<float> energy, mass, maxima;
    };

    int blocksOf(int samples) const { return (samples + m_side - 1) / m_side; }
    // Bounds that hold in every view exist only for fields without negative samples. Those smaller
    // than the rounding of floats, which resampling leaves where a field is 0, do not count.
    bool isPositive() const {
        const std::vector<float> &maxima = m_maxima[2].values;
        return -m_smallest <= double(std::numeric_limits<float>::epsilon() *
                                     *std::max_element(maxima.begin(), maxima.end())) &&
               m_mass > 0.0;
    }

    void sumLayer(int n) {
        Layer &layer = m_layers[std::size_t(n)];
        layer.alongI.resize(m_size.i);
        layer.alongJ.resize(m_size.j);
        layer.blocks.resize(std::size_t(m_across) * m_down);
        layer.blockMass.resize(layer.blocks.size());
        const int firstK = n * m_side, endK = std::min(m_size.k, firstK + m_side);
        layer.partEnergy.resize(std::size_t(endK - firstK) * m_ranges[1].size() *
                                m_ranges[0].size());
        layer.partMass.resize(layer.partEnergy.size());
        RowReader reader(m_field, m_box);
        RowSums sums(m_size.i);
        // Maxima by sample along i: of a row of blocks in one plane; of one row in all planes.
        std::vector<float> inPlane(std::size_t(m_size.i)), inRows(std::size_t(m_side) * m_size.i);
        for (int down = 0; down < m_down; ++down) {
            sums.clear();
            std::fill(inRows.begin(), inRows.end(), 0.0F);
            const int firstJ = down * m_side, endJ = std::min(m_size.j, firstJ + m_side);
            for (int k = firstK; k < endK; ++k) {
                std::fill(inPlane.begin(), inPlane.end(), 0.0F);
                reader.start(firstJ, k);
                for (int j = firstJ; j < endJ; ++j) {
                    const RowAndNeighbours rows = reader.next(j, k);
                    addRow(rows.here, m_size.i,
                           {sums.energy.data(), sums.mass.data(), sums.maxima.data(),
                            inPlane.data(), inRows.data() + std::size_t(j - firstJ) * m_size.i});
                    const double energy = addParts(rows.here, j, k - firstK, layer);
                    layer.alongJ[j] += energy;
                    m_result.axis[2][k] += energy;
                    layer.differences += allSquaredDifferences(rows, j, k, energy);
                    addRadius(rows.here, j, k, layer);
                }
                for (int block = 0; block < m_across; ++block)
                    m_maxima[2].at(k, down, block) = maxOf(inPlane.data(), block);
            }
            for (int j = firstJ; j < endJ; ++j)
                for (int block = 0; block < m_across; ++block)
                    m_maxima[1].at(j, block, n) =
                        maxOf(inRows.data() + std::size_t(j - firstJ) * m_size.i, block);
            addSums(sums, down, n);
        }
    }

    // Adds the blocks of a row to its plane; returns the row's energy.
    double addParts(const float *row, int j, int plane, Layer &layer) const {
        const std::size_t first =
            (std::size_t(plane) * m_ranges[1].size() + m_blockAt[1][std::size_t(j)]) *
            m_ranges[0].size();
        double energy = 0.0;
        for (std::size_t n = 0; n < m_ranges[0].size(); ++n) {
            const float *const part = row + m_ranges[0][n].first;
            const int count = m_ranges[0][n].last - m_ranges[0][n].first + 1;
            const PartSums sums = partSums(part, count);
            energy += double(sums.energy);
            layer.partEnergy[first + n] += double(sums.energy);
            layer.partMass[first + n] += double(sums.mass);
            layer.least = std::min(layer.least, double(sums.least));
        }
        return energy;
    }

    // The squares of the second differences at the samples of a row, at the two samples beyond its
    // ends, and in the rows beyond the box next to it. `energy`: of the row.
    double allSquaredDifferences(const RowAndNeighbours &rows, int j, int k, double energy) const {
        const float *const here = rows.here;
        const int count = m_size.i;
        double sum =
            energy * (int(j == 0) + int(j == m_size.j - 1) + int(k == 0) + int(k == m_size.k - 1));
        sum += squaredDifferences(rows, count);
        if (count == 1)
            return sum + 6.0 * energy;
        for (const auto &[end, next] : {std::pair(0, 1), std::pair(count - 1, count - 2)}) {
            const double f = double(here[end]), across = double(here[next]) - 2.0 * f;
            sum += across * across + f * f;
        }
        return sum;
    }

    float maxOf(const float *maxima, int block) const {
        return *std::max_element(maxima + block * m_side,
                                 maxima + std::min(m_size.i, (block + 1) * m_side));
    }

    // The distance of the outermost nonzero samples of a row.
    void addRadius(const float *row, int j, int k, Layer &layer) const {
        const float *const end = row + m_size.i;
        const auto isSet = [](float f) { return f != 0.0F; };
        const float *const first = std::find_if(row, end, isSet);
        if (first == end)
            return;
        const float *last = end - 1;
        while (!isSet(*last))
            --last;
        for (const float *const at : {first, last}) {
            const volume::VoxelIndex sample{int(at - row) + m_box.lo.i, j + m_box.lo.j,
                                            k + m_box.lo.k};
            layer.radiusMm =
                std::max(layer.radiusMm, glm::distance(m_center, m_lattice.patient(sample).mm));
        }
    }

    // Adds the sums of a row of blocks to layer n.
    void addSums(const RowSums &sums, int down, int n) {
        Layer &layer = m_layers[std::size_t(n)];
        for (int i = 0; i < m_size.i; ++i) {
            const std::size_t block = std::size_t(down) * m_across + std::size_t(i / m_side);
            layer.alongI[i] += double(sums.energy[i]);
            layer.blocks[block] += double(sums.energy[i]);
            layer.blockMass[block] += double(sums.mass[i]);
            m_maxima[0].at(i, n, down) = sums.maxima[i];
        }
    }

    void joinLayers() {
        double differences = 0.0;
        for (const Layer &layer : m_layers) {
            differences += layer.differences;
            m_smallest = std::min(m_smallest, layer.least);
            std::transform(layer.alongI.begin(), layer.alongI.end(), m_result.axis[0].begin(),
                           m_result.axis[0].begin(), std::plus<>());
            std::transform(layer.alongJ.begin(), layer.alongJ.end(), m_result.axis[1].begin(),
                           m_result.axis[1].begin(), std::plus<>());
            for (const double e : layer.blocks)
                m_energy += e;
            for (const double m : layer.blockMass)
                m_mass += m;
            m_spread.radiusMm = std::max(m_spread.radiusMm, layer.radiusMm);
        }
        if (!(m_energy > 0.0))
            return;
        m_roughness = differences / 16.0 / m_energy;
        for (auto &axis : m_result.axis)
            for (double &e : axis)
                e /= m_energy;
        joinParts();
    }

    void joinParts() {
        const std::size_t across = m_ranges[0].size(), plane = across * m_ranges[1].size();
        std::vector<double> energy(plane * m_ranges[2].size()), mass(energy.size());
        for (std::size_t k = 0; k < std::size_t(m_size.k); ++k) {
            const Layer &layer = m_layers[k / std::size_t(m_side)];
            const std::size_t from = k % std::size_t(m_side) * plane, to = m_blockAt[2][k] * plane;
            for (std::size_t n = 0; n < plane; ++n) {
                energy[to + n] += layer.partEnergy[from + n];
                mass[to + n] += layer.partMass[from + n];
            }
        }
        for (std::size_t n = 0; n < energy.size(); ++n)
            if (energy[n] > 0.0)
                m_result.blocks.push_back(
                    {{std::uint8_t(n % across), std::uint8_t(n % plane / across),
                      std::uint8_t(n / plane)},
                     float(energy[n] / m_energy),
                     m_mass != 0.0 ? float(mass[n] / m_mass) : 0.0F});
    }

    // The energy of the blocks by distance and, for a field without negative samples, their mass.
    MassInBalls profileBlocks() {
        DistanceProfiles profiles(m_spread);
        MassInBalls balls;
        const auto middle = [this](int block, int samples) {
            return 0.5 * (block * m_side + std::min(samples, (block + 1) * m_side) - 1);
        };
        for (std::size_t n = 0; n < m_layers.size(); ++n)
            for (int row = 0; row < m_down; ++row)
                for (int column = 0; column < m_across; ++column) {
                    const std::size_t block = std::size_t(row) * m_across + column;
                    const double energy = m_layers[n].blocks[block];
                    if (energy == 0.0)
                        continue;
                    const volume::VoxelPoint at{{m_box.lo.i + middle(column, m_size.i),
                                                 m_box.lo.j + middle(row, m_size.j),
                                                 m_box.lo.k + middle(int(n), m_size.k)}};
                    const glm::dvec3 fromCenterMm = m_lattice.patient(at).mm - m_center;
                    profiles.add(fromCenterMm, energy / m_energy);
                    if (m_isPositive)
                        balls.add(fromCenterMm, m_layers[n].blockMass[block] / m_mass);
                }
        return balls;
    }

    // Bounds that hold in every view of a field without negative samples.
    void boundAnyView(const MassInBalls &balls) {
        const glm::dvec3 cell(m_lattice.spacingMm(0), m_lattice.spacingMm(1),
                              m_lattice.spacingMm(2));
        const double ballBound = 1.0 / balls.minArea(0.5 * m_side * glm::length(cell));
        const double seen = leastProjectionEnergy(m_result.blocks, m_lattice, m_box);
        const double minEnergy = std::max(ballBound, seen);
        m_spread.leastProjection = minEnergy;
        m_spread.peakedness = std::max(1.0, largestLineIntegral(m_maxima, m_side, m_lattice) /
                                                (m_result.massMm3 * minEnergy));
        const double depthMm = 2.0 * m_spread.radiusMm + m_lattice.longestStepMm();
        m_spread.roughestView = depthMm * m_roughness * m_result.energyMm3 /
                                (m_result.massMm3 * m_result.massMm3 * minEnergy);
    }

    const volume::Field &m_field;
    const volume::Lattice &m_lattice;
    volume::VoxelBox m_box;
    volume::GridSize m_size;
    glm::dvec3 m_center;
    int m_side;           ///< of a block, samples
    int m_across, m_down; ///< blocks in a layer, along i and j
    std::vector<Layer> m_layers;
    std::array<std::vector<BlockRange>, 3> m_ranges;
    std::array<std::vector<std::size_t>, 3> m_blockAt; ///< of each sample along an axis
    std::array<LayerMaxima, 3> m_maxima;
    double m_energy = 0.0, m_mass = 0.0, m_smallest = 0.0; ///< of the field's samples
    bool m_isPositive = false;
    double m_roughness = 0.0; ///< the share of the energy near the highest frequencies, at most
    EnergyMarginals m_result;
    EnergySpread m_spread;
};

} // namespace

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
    spread.longestStepMm = lattice.longestStepMm();
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

EnergyMarginals energyMarginals(const volume::Field &field, const volume::VoxelBox &box) {
    return FieldStatistics(field, box).marginals();
}

} // namespace pellucid::field
