// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/energy_marginals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/plan/line_integral_bound.h"

namespace pellucid::plan {

namespace {

// The largest number of blocks along an axis; layers of blocks are processed independently.
constexpr int blocksAlong = 64;
// The number of bins that distances from the centre are sorted into, up to the radius.
constexpr int distanceSteps = 64;

// A quarter of the surface of the box, or of the enclosing sphere if that is smaller.
double shadowOf(const volume::Lattice &lattice, const volume::VoxelBox &box, double radiusMm) {
    const volume::GridSize size = box.size();
    const double i = size.i * lattice.spacingMm(0), j = size.j * lattice.spacingMm(1),
                 k = size.k * lattice.spacingMm(2);
    // A sample is as wide as a step, so it reaches half a step beyond its centre.
    const double reach = radiusMm + 0.5 * lattice.longestStepMm();
    return std::min(0.5 * (i * j + j * k + k * i), std::numbers::pi * reach * reach);
}

// Sums and extremes of the samples of one layer of blocks, which is a few planes k.
struct Layer {
    std::vector<double> alongI, alongJ; // energies
    std::vector<double> blocks;         // energies, [block along j][block along i]
    std::vector<double> blockMass;
    std::vector<float> mostOfRows; // [block along j][sample along i]
    double least = 0.0;
    double radiusMm = 0.0;
};

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
        m_spread.concentration = 0.0;
    }
    void add(const glm::dvec3 &fromCenterMm, double share) {
        m_spread.concentration += share * share;
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

// The mass of blocks by distance from the centre of mass.
class BallProfile {
public:
    // `share`: the block's share of the mass.
    void add(const glm::dvec3 &placeMm, double share) {
        m_blocks.push_back({placeMm, share});
        m_middle += share * placeMm;
    }

    // The minimum of pi R^2/m(R)^2 over R, where m(R) is the share of the mass in a ball of radius
    // R. The projection's energy is at least the square of the mass divided by this area. No sample
    // of a block is farther than `halfMm` from the block's middle.
    double leastArea(double halfMm) const {
        double radius = 0.0;
        for (const Block &block : m_blocks)
            radius = std::max(radius, glm::distance(block.placeMm, m_middle) + halfMm);
        constexpr int bins = 64;
        const double binMm = radius / bins;
        std::array<double, bins> within{};
        for (const Block &block : m_blocks) {
            const double mm = glm::distance(block.placeMm, m_middle) + halfMm;
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

private:
    struct Block {
        glm::dvec3 placeMm;
        double share;
    };
    std::vector<Block> m_blocks;
    glm::dvec3 m_middle{0.0};
};

// Coarser blocks than those above: the planner visits all of them for each layout.
std::vector<FieldBlock> fieldBlocks(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size(), size = box.size();
    const std::array<std::vector<BlockRange>, 3> ranges{blockRanges(size.i), blockRanges(size.j),
                                                        blockRanges(size.k)};
    const std::size_t across = ranges[0].size(), down = ranges[1].size(), deep = ranges[2].size();
    std::vector<double> energy(across * down * deep), mass(energy.size());
    field.visit([&](auto samples) {
        tbb::parallel_for(std::size_t(0), deep, [&](std::size_t c) {
            for (int k = ranges[2][c].first; k <= ranges[2][c].last; ++k)
                for (std::size_t b = 0; b < down; ++b)
                    for (int j = ranges[1][b].first; j <= ranges[1][b].last; ++j) {
                        const auto *const row =
                            samples.data() +
                            (std::size_t(k + box.lo.k) * lattice.j + j + box.lo.j) * lattice.i +
                            box.lo.i;
                        for (std::size_t a = 0; a < across; ++a) {
                            double squares = 0.0, sum = 0.0;
                            for (int i = ranges[0][a].first; i <= ranges[0][a].last; ++i) {
                                squares += double(row[i]) * double(row[i]);
                                sum += double(row[i]);
                            }
                            energy[(c * down + b) * across + a] += squares;
                            mass[(c * down + b) * across + a] += sum;
                        }
                    }
        });
    });
    double allEnergy = 0.0, allMass = 0.0;
    for (std::size_t n = 0; n < energy.size(); ++n) {
        allEnergy += energy[n];
        allMass += mass[n];
    }
    std::vector<FieldBlock> blocks;
    for (std::size_t n = 0; n < energy.size(); ++n)
        if (energy[n] > 0.0)
            blocks.push_back({{std::uint8_t(n % across), std::uint8_t(n / across % down),
                               std::uint8_t(n / across / down)},
                              float(energy[n] / allEnergy),
                              allMass != 0.0 ? float(mass[n] / allMass) : 0.0F});
    return blocks;
}

// The sum of the squared second differences along all axes. Beyond the box the field is zero.
double squaredSecondDifferences(const volume::Volume &field, const volume::VoxelBox &box) {
    const volume::GridSize lattice = field.lattice().size(), size = box.size();
    std::vector<double> ofPlane(std::size_t(size.k));
    field.visit([&](auto samples) {
        tbb::parallel_for(0, size.k, [&](int k) {
            const std::vector<typename decltype(samples)::value_type> none(std::size_t(size.i));
            const auto row = [&](int j, int depth) {
                const bool isInside = j >= 0 && j < size.j && depth >= 0 && depth < size.k;
                return isInside ? samples.data() +
                                      (std::size_t(depth + box.lo.k) * lattice.j + j + box.lo.j) *
                                          lattice.i +
                                      box.lo.i
                                : none.data();
            };
            double sum = 0.0;
            for (int j = -1; j <= size.j; ++j) {
                const auto *const here = row(j, k), *const above = row(j - 1, k),
                                  *const below = row(j + 1, k), *const before = row(j, k - 1),
                                  *const after = row(j, k + 1);
                float inRow = 0.0F;
                for (int i = 0; i < size.i; ++i) {
                    const float twice = 2.0F * float(here[i]);
                    const float down = float(above[i]) + float(below[i]) - twice,
                                deep = float(before[i]) + float(after[i]) - twice;
                    inRow += down * down + deep * deep;
                }
                for (int i = 1; i + 1 < size.i; ++i) {
                    const float across =
                        float(here[i - 1]) + float(here[i + 1]) - 2.0F * float(here[i]);
                    inRow += across * across;
                }
                sum += double(inRow);
                for (const int end : {0, size.i - 1}) { // and the samples beside them
                    const double f = double(here[end]);
                    const double next = size.i > 1 ? double(here[end == 0 ? 1 : end - 1]) : 0.0;
                    sum += (next - 2.0 * f) * (next - 2.0 * f) + f * f;
                }
            }
            ofPlane[std::size_t(k)] = sum;
        });
    });
    double sum = 0.0;
    for (const double of : ofPlane)
        sum += of;
    // Beyond the first and last plane.
    field.visit([&](auto samples) {
        for (const int k : {box.lo.k, box.hi.k - 1})
            for (int j = box.lo.j; j < box.hi.j; ++j)
                for (int i = box.lo.i; i < box.hi.i; ++i) {
                    const double f = double(
                        samples[(std::size_t(k) * lattice.j + j) * std::size_t(lattice.i) + i]);
                    sum += f * f;
                }
    });
    return sum;
}

// Between the directions that `leastProjectionEnergy` samples, the energy does not fall below this
// share of the minimum found: aligned parts make narrow peaks of the energy, not narrow valleys.
constexpr double leastSeen = 0.85;

// The smallest energy of the projections of a field along some directions, for a field of mass 1
// without negative samples. It is computed from the masses of blocks; spreading each mass over its
// block lowers the energy, so the result is below the true one.
double leastProjectionEnergy(const std::vector<FieldBlock> &blocks, const volume::Lattice &lattice,
                             const volume::VoxelBox &box) {
    constexpr int views = 64, most = 128;
    const volume::GridSize size = box.size();
    std::array<std::vector<BlockRange>, 3> ranges;
    double pixelMm = 0.0, radiusMm = 0.0;
    for (int d = 0; d < 3; ++d) {
        ranges[std::size_t(d)] = blockRanges(size[d]);
        pixelMm = std::max(pixelMm,
                           lattice.spacingMm(d) * size[d] / double(ranges[std::size_t(d)].size()));
    }
    const glm::dvec3 middle =
        lattice
            .patient(volume::VoxelPoint{0.5 * (glm::dvec3(box.lo.i, box.lo.j, box.lo.k) +
                                               glm::dvec3(box.hi.i, box.hi.j, box.hi.k) - 1.0)})
            .mm;
    std::vector<glm::dvec3> places;
    for (const FieldBlock &block : blocks) {
        glm::dvec3 at(box.lo.i, box.lo.j, box.lo.k);
        for (int d = 0; d < 3; ++d) {
            const BlockRange &range = ranges[std::size_t(d)][block.at[std::size_t(d)]];
            at[d] += 0.5 * (range.first + range.last);
        }
        places.push_back(lattice.patient(volume::VoxelPoint{at}).mm - middle);
        radiusMm = std::max(radiusMm, glm::length(places.back()));
    }
    pixelMm = std::max(pixelMm, 2.0 * radiusMm / (most - 3));
    const int side = int(2.0 * radiusMm / pixelMm) + 3;
    std::array<double, views> energies{};
    tbb::parallel_for(0, views, [&](int n) {
        // Directions evenly over half a sphere, along a spiral.
        const double z = (n + 0.5) / views, angle = n * std::numbers::pi * (3.0 - std::sqrt(5.0)),
                     r = std::sqrt(1.0 - z * z);
        const glm::dvec3 w(r * std::cos(angle), r * std::sin(angle), z),
            u = glm::normalize(glm::cross(w, glm::dvec3(0.0, 1.0, 0.0))), v = glm::cross(w, u);
        std::vector<double> picture(std::size_t(side) * std::size_t(side));
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const double x = glm::dot(places[b], u) / pixelMm + 0.5 * (side - 1),
                         y = glm::dot(places[b], v) / pixelMm + 0.5 * (side - 1);
            const double column = std::floor(x), row = std::floor(y), right = x - column,
                         down = y - row, mass = double(blocks[b].mass);
            double *const at =
                picture.data() + std::size_t(row) * std::size_t(side) + std::size_t(column);
            at[0] += mass * (1.0 - right) * (1.0 - down);
            at[1] += mass * right * (1.0 - down);
            at[side] += mass * (1.0 - right) * down;
            at[side + 1] += mass * right * down;
        }
        for (const double sum : picture)
            energies[std::size_t(n)] += sum * sum / (pixelMm * pixelMm);
    });
    return *std::min_element(energies.begin(), energies.end());
}

} // namespace

std::vector<BlockRange> blockRanges(int samples) {
    constexpr int most = 20;
    const int count = std::min(samples, most);
    std::vector<BlockRange> ranges;
    for (int n = 0; n < count; ++n)
        ranges.push_back({int(std::int64_t(n) * samples / count),
                          int(std::int64_t(n + 1) * samples / count) - 1});
    return ranges;
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
    spread.shortestStepMm = places.shortestStepMm();
    spread.longestStepMm = places.longestStepMm();
    result.axis[2].resize(size.k);
    std::vector<Layer> layers(blocksOf(size.k));
    std::array<LayerMaxima, 3> maxima;
    for (int d = 0; d < 3; ++d) {
        LayerMaxima &of = maxima[std::size_t(d)];
        of.samples = size[d];
        of.columns = blocksOf(size[(d + 1) % 3]);
        of.rows = blocksOf(size[(d + 2) % 3]);
        of.most.resize(std::size_t(of.samples) * std::size_t(of.columns) * std::size_t(of.rows));
    }
    field.visit([&](auto samples) {
        tbb::parallel_for(std::size_t(0), layers.size(), [&](std::size_t n) {
            Layer &layer = layers[n];
            layer.alongI.resize(size.i);
            layer.alongJ.resize(size.j);
            layer.blocks.resize(std::size_t(across) * down);
            layer.blockMass.resize(layer.blocks.size());
            layer.mostOfRows.resize(std::size_t(size.i) * down);
            for (int k = int(n) * side; k < std::min(size.k, int(n + 1) * side); ++k)
                for (int j = 0; j < size.j; ++j) {
                    const auto *const row = samples.data() + rowStart(j, k);
                    double inRow = 0.0;
                    int first = size.i, last = -1;
                    float *const mostOfRows =
                        layer.mostOfRows.data() + std::size_t(j / side) * std::size_t(size.i);
                    for (int i = 0; i < size.i; ++i) {
                        const double f = double(row[i]);
                        layer.alongI[i] += f * f;
                        mostOfRows[i] = std::max(mostOfRows[i], float(row[i]));
                        layer.least = std::min(layer.least, f);
                        if (f != 0.0) {
                            first = std::min(first, i);
                            last = i;
                        }
                    }
                    for (int block = 0; block < across; ++block) {
                        double inBlock = 0.0, mass = 0.0;
                        float most = 0.0F;
                        for (int i = block * side; i < std::min(size.i, (block + 1) * side); ++i) {
                            inBlock += double(row[i]) * double(row[i]);
                            mass += double(row[i]);
                            most = std::max(most, float(row[i]));
                        }
                        const std::size_t at = std::size_t(j / side) * across + block;
                        layer.blocks[at] += inBlock;
                        layer.blockMass[at] += mass;
                        for (float *const square :
                             {&maxima[1].at(j, block, int(n)), &maxima[2].at(k, j / side, block)})
                            *square = std::max(*square, most);
                        inRow += inBlock;
                    }
                    for (const int end : {first, last})
                        if (last >= 0) {
                            const volume::VoxelIndex at{end + box.lo.i, j + box.lo.j, k + box.lo.k};
                            layer.radiusMm = std::max(layer.radiusMm,
                                                      glm::distance(center, places.patient(at).mm));
                        }
                    layer.alongJ[j] += inRow;
                    result.axis[2][k] += inRow;
                }
            for (int row = 0; row < down; ++row)
                for (int i = 0; i < size.i; ++i)
                    maxima[0].at(i, int(n), row) =
                        layer.mostOfRows[std::size_t(row) * std::size_t(size.i) + i];
        });
    });
    // Layers are added in order, so the sums do not depend on the number of threads.
    double total = 0.0;
    result.axis[0].resize(size.i);
    result.axis[1].resize(size.j);
    double least = 0.0;
    for (const Layer &layer : layers) {
        least = std::min(least, layer.least);
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
    double mass = 0.0;
    for (const Layer &layer : layers)
        for (const double m : layer.blockMass)
            mass += m;
    const bool isPositive = least >= 0.0 && mass > 0.0;
    BallProfile balls;
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
                const glm::dvec3 from = places.patient(at).mm - center;
                profiles.add(from, energy / total);
                const std::size_t block = std::size_t(row) * across + column;
                if (isPositive)
                    balls.add(from, layers[n].blockMass[block] / mass);
            }
    result.blocks = fieldBlocks(field, box);
    result.massMm3 = mass * places.cellVolumeMm3();
    result.energyMm3 = total * places.cellVolumeMm3();
    if (total > 0.0)
        spread.roughness = squaredSecondDifferences(field, box) / 16.0 / total;
    if (isPositive) {
        const glm::dvec3 cell(places.spacingMm(0), places.spacingMm(1), places.spacingMm(2));
        const double inBall = 1.0 / balls.leastArea(0.5 * side * glm::length(cell));
        const double seen = leastSeen * leastProjectionEnergy(result.blocks, places, box);
        const double leastEnergy = std::max(inBall, seen);
        spread.peakedness = std::max(1.0, largestLineIntegral(maxima, side, places) /
                                              (result.massMm3 * leastEnergy));
        const double depthMm = 2.0 * spread.radiusMm + places.longestStepMm();
        spread.roughestView = depthMm * spread.roughness * result.energyMm3 /
                              (result.massMm3 * result.massMm3 * leastEnergy);
    }
    result.spread = std::make_shared<const EnergySpread>(std::move(spread));
    return result;
}

} // namespace pellucid::plan
