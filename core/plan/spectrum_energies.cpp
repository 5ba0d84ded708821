// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/spectrum_energies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/plan/spectrum_blocks.h"
#include "core/task/error.h"

namespace pellucid::plan {

namespace {

constexpr double pi = std::numbers::pi;

// Blocks have half the error at their brightest cell.
constexpr float brightestShare = 2.0F;
// Points are closer than blocks are long, so that a block in a patch has a point.
constexpr double cellsPerPoint = 6.5;
// Patches of fewer cells are small, see PatchPoints.
constexpr double smallestPatch = 12.0;
// Cells beyond a patch that the kernels of its frequencies read. A block may end there.
constexpr double aroundPatch = 1.5;
// Margin for the energy of a view, which is sampled by direction.
constexpr double minEnergyMargin = 0.8;
// The reconstruction's factor is tabled to here; beyond, it stays below its largest value there.
constexpr float factorsPerCycle = 128.0F;
constexpr int tabledCycles = 4;

// Directions on three faces of a cube; opposite ones have the same energy.
constexpr int faceSide = 8;
constexpr int directionCount = 3 * faceSide * faceSide;

// `a` and `b`: away from the middle of the part that a direction represents, -0.5 to 0.5.
glm::dvec3 directionOf(int n, double a, double b) {
    const int face = n / (faceSide * faceSide);
    const auto tangent = [](double at) {
        return std::tan(0.25 * pi * ((2.0 * at + 1.0) / faceSide - 1.0));
    };
    glm::dvec3 direction;
    direction[face] = 1.0;
    direction[(face + 1) % 3] = tangent(n / faceSide % faceSide + a); // NOLINT: whole
    direction[(face + 2) % 3] = tangent(n % faceSide + b);
    return glm::normalize(direction);
}

int indexOf(const glm::dvec3 &direction) {
    const glm::dvec3 a = glm::abs(direction);
    const int face = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const auto at = [&](int axis) {
        const double angle = std::atan(direction[axis] / direction[face]) / (0.25 * pi);
        return std::clamp(int(0.5 * (angle + 1.0) * faceSide), 0, faceSide - 1);
    };
    return (face * faceSide + at((face + 1) % 3)) * faceSide + at((face + 2) % 3);
}

} // namespace

struct SpectrumEnergies::Blocks {
    Blocks(const fourier::Spectrum &spectrum, const fourier::KernelsByWidth &kernels,
           const scene::ImageDefinition &image)
        : blocks(spectrum, kernels), lattice(spectrum.lattice()), padded(spectrum.layout().padded),
          factors(factorBounds(image)) {}

    // The largest squared factor of the reconstruction at a frequency or beyond it, along one axis.
    static std::vector<float> factorBounds(const scene::ImageDefinition &image) {
        constexpr int finer = 8;
        std::vector<float> bounds(std::size_t(tabledCycles * int(factorsPerCycle)) + 1, 0.0F);
        float largest = 0.0F;
        // The lobe beyond the table is larger than those that follow.
        for (int n = (int(bounds.size()) + int(factorsPerCycle)) * finer; n-- > 0;) {
            const double factor =
                scene::reconstructionFactor(image, n / (double(factorsPerCycle) * finer));
            largest = std::max(largest, float(factor * factor));
            if (const auto at = std::size_t(n / finer); at < bounds.size())
                bounds[at] = largest;
        }
        return bounds;
    }

    // For `slabs`: first by block, then by the distance of its cells.
    void boundEnergies() {
        const std::array<int, 3> counts{blocks.columns, blocks.rows, blocks.planes};
        std::array<std::vector<float>, 3> most;
        for (std::size_t d = 0; d < 3; ++d)
            most[d].resize(std::size_t(counts[d]), 0.0F);
        const float *errors = blocks.errors.data();
        for (int z = 0; z < counts[2]; ++z)
            for (int y = 0; y < counts[1]; ++y)
                for (int x = 0; x < counts[0]; ++x, errors += blocks.entries)
                    for (const auto &[d, at] : {std::pair(0, x), std::pair(1, y), std::pair(2, z)})
                        most[std::size_t(d)][std::size_t(at)] =
                            std::max(most[std::size_t(d)][std::size_t(at)], errors[0]);
        for (std::size_t d = 0; d < 3; ++d) {
            const int size = d == 0 ? blocks.step : fourier::CellLayout::planesTogether;
            std::vector<float> byCell(std::size_t(padded[int(d)] / 2) + 1, 0.0F);
            const int last = int(byCell.size()) - 1 - int(blocks.firstCell[d]);
            for (int at = 0; at <= last; ++at) {
                const auto cell = std::size_t(std::abs(int(blocks.firstCell[d]) + at));
                if (cell < byCell.size())
                    byCell[cell] = std::max(
                        byCell[cell], most[d][std::size_t(std::min(at / size, counts[d] - 1))]);
            }
            slabs[d].resize(byCell.size());
            for (std::size_t cell = 0; cell < byCell.size(); ++cell)
                slabs[d][cell] = *std::max_element(
                    byCell.begin() + std::ptrdiff_t(cell),
                    byCell.begin() + std::ptrdiff_t(std::min(cell + slabCells, byCell.size())));
        }
    }

    // Cells along each axis per cycle per mm in a direction.
    glm::dvec3 cellsPer(const glm::dvec3 &direction) const {
        glm::dvec3 cells;
        for (int d = 0; d < 3; ++d)
            cells[d] = padded[d] * glm::dot(lattice.step(d), direction);
        return cells;
    }

    // The integral of the energy times the radius, up to a radius.
    double energyAlong(const glm::dvec3 &direction, double radiusPerMm,
                       const fourier::Spectrum &spectrum,
                       const scene::ImageDefinition &image) const {
        constexpr int points = 24;
        const glm::dvec3 cells = cellsPer(direction);
        const double step = radiusPerMm / points;
        double sum = 0.0;
        for (int k = 0; k < points; ++k) {
            const double radius = (k + 0.5) * step;
            double factor = 1.0;
            for (int d = 0; d < 3; ++d)
                factor *= scene::reconstructionFactor(image, radius * cells[d] / padded[d]);
            const glm::dvec3 at = radius * cells;
            sum += radius * step * factor * factor *
                   std::norm(spectrum.between({at.x, at.y, at.z}, spectrum.layout().kernels));
        }
        return sum;
    }

    SpectrumBlocks blocks;
    volume::Lattice lattice;
    volume::GridSize padded;
    std::vector<float> factors;
    /// By axis: the largest energy of a slab of `slabCells` cells, by the distance of its first
    /// cell from frequency 0.
    static constexpr std::size_t slabCells = 32;
    std::array<std::vector<float>, 3> slabs;
};

SpectrumEnergies::SpectrumEnergies(const fourier::Spectrum &spectrum,
                                   const fourier::KernelsByWidth &kernels,
                                   const scene::ImageDefinition &image, double tolerance,
                                   const task::Progress &progress) {
    const auto made = task::orOutOfMemory(task::because::noMemoryForTheKernelWidths, [&] {
        return std::make_shared<Blocks>(spectrum, kernels, image);
    });
    const volume::Lattice &lattice = made->lattice;
    double cellsPerMm = 0.0;
    for (int d = 0; d < 3; ++d)
        cellsPerMm = std::max(cellsPerMm, made->padded[d] * lattice.spacingMm(d));
    const double lowPerMm = lowCells / cellsPerMm;
    m_low.resize(directionCount);
    tbb::parallel_for(0, directionCount, [&](int n) {
        // The spectrum of a sheet is a line that may be narrower than the distance of directions.
        double sum = 0.0;
        for (const double a : {-0.25, 0.25})
            for (const double b : {-0.25, 0.25})
                sum += 0.25 * made->energyAlong(directionOf(n, a, b), lowPerMm, spectrum, image);
        m_low[std::size_t(n)] = float(sum);
    });
    // A plane that is dark everywhere, as far as twice the Nyquist frequency, has so little.
    constexpr double darkShare = 1e-3;
    const double farthestPerMm = 1.0 / lattice.shortestStepMm();
    const double dark =
        darkShare * tolerance * tolerance * minEnergyOfAll() / (pi * farthestPerMm * farthestPerMm);
    SpectrumBlocks &blocks = made->blocks;
    tbb::parallel_for(0, blocks.columns * blocks.planes, [&](int part) {
        progress.check();
        measureBlocks(spectrum, part / blocks.planes, part % blocks.planes, float(dark), blocks);
    });
    made->boundEnergies();
    m_blocks = made;
}

const volume::GridSize &SpectrumEnergies::padded() const {
    return m_blocks->padded;
}

std::size_t SpectrumEnergies::entryOf(int width) {
    return std::size_t(SpectrumBlocks::entryOf(width));
}

float SpectrumEnergies::energyBound(const PlanePatch &patch) const {
    const Blocks &all = *m_blocks;
    const int lastFactor = int(all.factors.size()) - 1;
    float factor = 1.0F, energy = std::numeric_limits<float>::infinity();
    for (std::size_t d = 0; d < 3; ++d) {
        const auto padded = float(all.padded[int(d)]);
        const auto middle = float(patch.middle(d)), reach = float(patch.reach(d));
        const float nearest = std::max(0.0F, std::abs(middle) - reach);
        factor *=
            all.factors[std::size_t(std::min(lastFactor, int(nearest / padded * factorsPerCycle)))];
        const float folded = std::abs(
            middle - padded * float(int(middle / padded + (middle < 0.0F ? -0.5F : 0.5F))));
        const std::vector<float> &slabs = all.slabs[d];
        float most = 0.0F;
        const auto last = std::min(slabs.size() - 1, std::size_t(folded + reach) + 1);
        for (auto cell = std::min(last, std::size_t(std::max(0.0F, folded - reach))); cell <= last;
             cell += Blocks::slabCells)
            most = std::max(most, slabs[cell]);
        energy = std::min(energy, most);
    }
    return brightestShare * factor * energy;
}

double PlanePatch::middle(std::size_t d) const {
    return offset[d] + (firstColumn + 0.5 * columns) * perColumn[d] +
           (firstRow + 0.5 * rows) * perRow[d];
}

double PlanePatch::reach(std::size_t d) const {
    return 0.5 * (std::abs(perColumn[d]) * columns + std::abs(perRow[d]) * rows);
}

PatchPoints::PatchPoints(const PlanePatch &patch) {
    const auto longest = [](const std::array<double, 3> &per) {
        return std::max({std::abs(per[0]), std::abs(per[1]), std::abs(per[2]), 1e-12});
    };
    const double cellsU = longest(patch.perColumn) * patch.columns,
                 cellsV = longest(patch.perRow) * patch.rows;
    isSmall = std::min(cellsU, cellsV) < smallestPatch;
    const auto countAlong = [&](double length) {
        return std::max(3, 1 + int(std::ceil((length + 2.0 * aroundPatch) / cellsPerPoint)));
    };
    const int countU = countAlong(cellsU), countV = countAlong(cellsV);
    count = std::size_t(countU) * std::size_t(countV);
    const double aroundU = aroundPatch / cellsU, aroundV = aroundPatch / cellsV;
    const double stepU = patch.columns * (1.0 + 2.0 * aroundU) / (countU - 1),
                 stepV = patch.rows * (1.0 + 2.0 * aroundV) / (countV - 1);
    const double firstU = -aroundU * patch.columns, firstV = -aroundV * patch.rows;
    for (std::size_t d = 0; d < 3; ++d) {
        for (int v = 0; v < countV; ++v)
            for (int u = 0; u < countU; ++u)
                cells[d].push_back(float((firstU + u * stepU) * patch.perColumn[d] +
                                         (firstV + v * stepV) * patch.perRow[d]));
        cells[d].resize((count + vector - 1) / vector * vector, cells[d].back());
        reach[d] =
            float(0.5 * (std::abs(stepU * patch.perColumn[d]) + std::abs(stepV * patch.perRow[d])));
    }
}

SpectrumEnergies::Errors SpectrumEnergies::errorsIn(const PlanePatch &patch,
                                                    const PatchPoints &points) const {
    const Blocks &all = *m_blocks;
    PointSum sum{.blocks = &all.blocks,
                 .count = points.count,
                 .takesLargest = points.isSmall,
                 .factors = all.factors.data(),
                 .factorsPerCycle = factorsPerCycle,
                 .lastFactor = int(all.factors.size()) - 1};
    for (std::size_t d = 0; d < 3; ++d) {
        sum.cells[d] = points.cells[d].data();
        sum.first[d] = float(patch.offset[d] + patch.firstColumn * patch.perColumn[d] +
                             patch.firstRow * patch.perRow[d]);
        sum.padded[d] = float(all.padded[int(d)]);
        sum.reach[d] = points.reach[d] / sum.padded[d];
    }
    Errors errors{};
    sumErrors(sum, errors.data());
    // A line of cells may fill a small patch, which then has all of the brightest cell's error, not
    // the half that blocks have.
    const float scale = points.isSmall ? brightestShare : 1.0F / float(points.count);
    for (float &error : errors)
        error *= scale;
    return errors;
}

double SpectrumEnergies::minEnergyOfAll() const {
    return 2.0 * pi * minEnergyMargin * double(*std::min_element(m_low.begin(), m_low.end()));
}

double SpectrumEnergies::minEnergy(const glm::dmat3 &axes) const {
    constexpr int points = 64;
    double sum = 0.0;
    for (int n = 0; n < points; ++n) {
        const double angle = pi * (n + 0.5) / points;
        sum += m_low[std::size_t(indexOf(std::cos(angle) * axes[0] + std::sin(angle) * axes[1]))];
    }
    return 2.0 * minEnergyMargin * sum * pi / points;
}

} // namespace pellucid::plan
