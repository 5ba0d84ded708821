// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plan/own_band.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/plan/spectrum_blocks.h"
#include "core/task/error.h"

namespace pellucid::plan {

namespace {

constexpr double pi = std::numbers::pi;

// Rings are this share of the Nyquist frequency of the shortest step wide.
constexpr double ringShare = 1.0 / 16.0;
// Beyond so many times that frequency the reconstruction leaves next to nothing.
constexpr double farthest = 4.0;
// Blocks of 8 cells say nothing of the energies nearer to frequency 0 than this, in cells.
constexpr double lowCells = 12.0;
constexpr double cellsPerPoint = 8.0;
// Of the energy of a view by directions; of the energy beyond a ring by blocks.
constexpr double leastMargin = 0.9, blockMargin = 1.5;
constexpr float factorsPerCycle = 64.0F;

// Directions on three faces of a cube; opposite ones have the same energy.
constexpr int faceSide = 8;
constexpr int directionCount = 3 * faceSide * faceSide;

glm::dvec3 directionOf(int n) {
    const int face = n / (faceSide * faceSide);
    const auto tangent = [](int at) {
        return std::tan(0.25 * pi * ((2 * at + 1.0) / faceSide - 1.0));
    };
    glm::dvec3 direction;
    direction[face] = 1.0;
    direction[(face + 1) % 3] = tangent(n / faceSide % faceSide);
    direction[(face + 2) % 3] = tangent(n % faceSide);
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

// |F|^2 between the cells of a half spectrum.
double energyAt(const fourier::Spectrum &spectrum, glm::dvec3 cell) {
    const fourier::SpectrumLayout &layout = spectrum.layout();
    const int width = layout.width();
    if (cell.x < 0.0)
        cell = -cell;
    std::array<std::array<double, fourier::Kernel::largestWidth>, 3> taps;
    glm::ivec3 first;
    for (int d = 0; d < 3; ++d) {
        first[d] = int(std::ceil(cell[d] - 0.5 * width));
        for (int k = 0; k < width; ++k)
            taps[std::size_t(d)][std::size_t(k)] =
                layout.kernels[std::size_t(d)].value(first[d] + k - cell[d]);
    }
    std::complex<double> sum = 0.0;
    for (int z = 0; z < width; ++z)
        for (int y = 0; y < width; ++y) {
            std::complex<double> row = 0.0;
            for (int x = 0; x < width; ++x)
                row += taps[0][std::size_t(x)] *
                       spectrum.value(first[0] + x, first[1] + y, first[2] + z);
            sum += taps[1][std::size_t(y)] * taps[2][std::size_t(z)] * row;
        }
    return std::norm(sum);
}

} // namespace

struct SpectrumEnergies::Blocks {
    explicit Blocks(const fourier::Spectrum &spectrum)
        : blocks(spectrum), lattice(spectrum.lattice()), padded(spectrum.layout().padded) {}

    // Cells along each axis per cycle per mm in a direction.
    glm::dvec3 cellsPer(const glm::dvec3 &direction) const {
        glm::dvec3 cells;
        for (int d = 0; d < 3; ++d)
            cells[d] = padded[d] * glm::dot(lattice.step(d), direction);
        return cells;
    }

    SpectrumBlocks blocks;
    volume::Lattice lattice;
    volume::GridSize padded;
    std::vector<float> factors; ///< the reconstruction's, squared
    double nyquistPerMm = 0.0;
};

SpectrumEnergies::SpectrumEnergies(const fourier::Spectrum &spectrum,
                                   const scene::ImageDefinition &image,
                                   const task::Progress &progress) {
    const auto made = task::orOutOfMemory(task::because::noMemoryForAnImage,
                                          [&] { return std::make_shared<Blocks>(spectrum); });
    SpectrumBlocks &blocks = made->blocks;
    tbb::parallel_for(0, blocks.columns * blocks.planes, [&](int part) {
        progress.check();
        measureBlocks(spectrum, part / blocks.planes, part % blocks.planes, blocks);
    });
    const volume::Lattice &lattice = made->lattice;
    made->nyquistPerMm = 0.5 / lattice.shortestStepMm();
    m_ringPerMm = ringShare * made->nyquistPerMm;
    double cellsPerMm = 0.0;
    for (int d = 0; d < 3; ++d)
        cellsPerMm = std::max(cellsPerMm, made->padded[d] * lattice.spacingMm(d));
    m_lowPerMm = lowCells / cellsPerMm;
    const double mostCycles = farthest * made->nyquistPerMm * lattice.longestStepMm();
    for (int n = 0; n <= int(std::ceil(mostCycles * factorsPerCycle)); ++n) {
        const double factor = scene::reconstructionFactor(image, n / double(factorsPerCycle));
        made->factors.push_back(float(factor * factor));
    }
    m_low.resize(directionCount);
    tbb::parallel_for(0, directionCount, [&](int n) {
        constexpr int points = 24;
        const glm::dvec3 direction = directionOf(n), cells = made->cellsPer(direction);
        const double step = m_lowPerMm / points;
        double sum = 0.0;
        for (int k = 0; k < points; ++k) {
            const double radius = (k + 0.5) * step;
            sum += radius * step * energyAt(spectrum, radius * cells);
        }
        m_low[std::size_t(n)] = float(sum);
    });
    m_blocks = made;
}

std::vector<double> SpectrumEnergies::rings(const glm::dmat3 &axes, double limitPerMm) const {
    const Blocks &all = *m_blocks;
    const glm::dvec3 perU = all.cellsPer(axes[0]), perV = all.cellsPer(axes[1]);
    // No step is longer than a block, nor than a sixteenth of a short axis.
    const auto stepOf = [&](const glm::dvec3 &perMm) {
        double step = std::numeric_limits<double>::infinity();
        for (int d = 0; d < 3; ++d)
            step = std::min(step, std::min(cellsPerPoint, all.padded[d] / 16.0) /
                                      std::max(1e-12, std::abs(perMm[d])));
        return step;
    };
    const double limit = std::min(limitPerMm, farthest * all.nyquistPerMm);
    const double stepU = stepOf(perU), stepV = stepOf(perV);
    PlaneWalk walk;
    walk.blocks = &all.blocks;
    for (int d = 0; d < 3; ++d) {
        const auto axis = std::size_t(d);
        walk.padded[axis] = float(all.padded[d]);
        walk.perU[axis] = float(perU[d] * stepU);
        walk.perV[axis] = float(perV[d] * stepV);
    }
    walk.stepU = float(stepU / m_ringPerMm);
    walk.stepV = float(stepV / m_ringPerMm);
    walk.countU = int(limit / stepU);
    walk.countV = int(limit / stepV);
    walk.factors = all.factors.data();
    walk.factorsPerCycle = factorsPerCycle;
    walk.lastFactor = int(all.factors.size()) - 1;
    walk.rings = int(std::ceil(limit / m_ringPerMm));
    std::vector<float> half(std::size_t(walk.rings));
    for (int v = 0; v <= walk.countV; ++v)
        walkRow(walk, v, half.data());
    std::vector<double> rings;
    for (const float sum : half)
        rings.push_back(2.0 * stepU * stepV * sum);
    return rings;
}

double SpectrumEnergies::least(const glm::dmat3 &axes) const {
    constexpr int points = 64;
    double sum = 0.0;
    for (int n = 0; n < points; ++n) {
        const double angle = pi * (n + 0.5) / points;
        sum += m_low[std::size_t(indexOf(std::cos(angle) * axes[0] + std::sin(angle) * axes[1]))];
    }
    return 2.0 * leastMargin * sum * pi / points;
}

OwnBand::Reach OwnBand::reach(const glm::dmat3 &axes, std::span<const Weights> weights,
                              double limitPerMm) const {
    double least = 0.0, ringPerMm = 1.0;
    std::array<std::vector<double>, 3> beyond;
    for (std::size_t f = 0; f < m_fields.size(); ++f) {
        if (weights[f] == Weights{})
            continue;
        const SpectrumEnergies &field = *m_fields[f];
        ringPerMm = field.ringPerMm();
        std::vector<double> rings = field.rings(axes, limitPerMm);
        for (std::size_t n = rings.size(); n-- > 1;)
            rings[n - 1] += rings[n];
        const double leastOfField = field.least(axes);
        for (std::size_t c = 0; c < 3; ++c) {
            beyond[c].resize(rings.size());
            // Amplitudes of fields without negative samples add up; so do their projections.
            for (std::size_t n = 0; n < rings.size(); ++n)
                beyond[c][n] += std::abs(weights[f][c]) * std::sqrt(rings[n]);
            least += weights[f][c] * weights[f][c] * leastOfField;
        }
    }
    const std::size_t count = beyond[0].size();
    const auto leftBeyond = [&](std::size_t ring) {
        double energy = 0.0;
        for (const std::vector<double> &color : beyond)
            energy += color[ring] * color[ring];
        return std::sqrt(blockMargin * energy / least);
    };
    std::size_t ring = count;
    const auto first = std::size_t(std::ceil(m_fields.front()->lowPerMm() / ringPerMm));
    while (ring > first && least > 0.0 && leftBeyond(ring - 1) <= m_tolerance)
        --ring;
    return ring < count ? Reach{double(ring) * ringPerMm, leftBeyond(ring)}
                        : Reach{limitPerMm, 0.0};
}

} // namespace pellucid::plan
