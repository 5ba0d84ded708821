// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/slice_energies.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/render/slice_reader.h"

namespace pellucid::accuracy {

namespace {

constexpr int directions = SliceEnergies::directions;
// Rings grow geometrically, because most of the energy is near frequency 0.
constexpr int rings = 24, perRing = 24, perDirection = 12;
constexpr double band = 0.5; // the radius of the band's disc, cycles per pixel

using Energies = std::array<double, 3>; // by channel

class SliceSampler {
public:
    SliceSampler(const render::EngineSpectra &spectra, const render::FrameInputs &inputs,
                 const scene::Camera &camera, const scene::ImageDefinition &image)
        : m_inputs(inputs), m_image(image), m_layout(spectra.fields.front()->layout()),
          m_reader(spectra, inputs.mixing, inputs.shading, render::SliceReader::Rounding::unknown),
          m_densityUnit(1.0 / (camera.pixelMm * camera.pixelMm)) {}

    SliceEnergies energies() {
        sampleRings();
        sampleEdge();
        std::vector<Energies> densities(m_samples.size());
        tbb::parallel_for(std::size_t(0), m_samples.size(),
                          [&](std::size_t n) { densities[n] = densityAt(m_samples[n]); });
        SliceEnergies energies;
        for (std::size_t n = 0; n < m_samples.size(); ++n) {
            const Sample &sample = m_samples[n];
            for (std::size_t c = 0; c < 3; ++c)
                (sample.direction < 0 ? energies.whole[c]
                                      : energies.edge[c][std::size_t(sample.direction)]) +=
                    sample.weight * densities[n][c];
        }
        return energies;
    }

private:
    struct Sample {
        double x = 0.0, y = 0.0; ///< frequency, cycles per pixel
        double weight = 1.0;
        int direction = -1; ///< -1: of the whole
    };

    // The innermost disc is one frequency of the grid, which is known.
    void sampleRings() {
        const double inner = band / std::max(m_inputs.grid.columns, m_inputs.grid.rows),
                     growth = std::pow(band / inner, 1.0 / rings);
        m_samples.push_back({0.0, 0.0, std::numbers::pi * inner * inner});
        for (int ring = 0; ring < rings; ++ring) {
            const double from = inner * std::pow(growth, ring), to = from * growth,
                         area = std::numbers::pi * (to * to - from * from);
            for (int n = 0; n < perRing; ++n) {
                const double angle = std::numbers::pi * (n + m_even(m_random)) / perRing,
                             radius = std::sqrt(from * from +
                                                m_even(m_random) * (to * to - from * from));
                m_samples.push_back(
                    {radius * std::cos(angle), radius * std::sin(angle), area / perRing});
            }
        }
    }

    // In the outer part of the band that the roll-off hardly reduces.
    void sampleEdge() {
        for (int direction = 0; direction < directions; ++direction)
            for (int n = 0; n < perDirection; ++n) {
                const double angle = std::numbers::pi *
                                     (direction + (n + m_even(m_random)) / perDirection) /
                                     directions,
                             radius =
                                 band * (1.0 - m_image.rollOff * (0.4 + 0.6 * m_even(m_random)));
                m_samples.push_back({radius * std::cos(angle), radius * std::sin(angle),
                                     1.0 / perDirection, direction});
            }
    }

    // Frequencies outside the lattice's band count as the engine reads them.
    Energies densityAt(const Sample &sample) const {
        std::array<double, 3> cells{};
        const bool isWhole = sample.direction < 0;
        double factor =
            isWhole ? scene::rollOffFactor(m_image.rollOff, std::hypot(sample.x, sample.y) / band)
                    : 1.0;
        for (std::size_t d = 0; d < 3; ++d) {
            // Rows run downward, against V.
            cells[d] = sample.x * m_inputs.grid.columns * m_inputs.geometry.cellsPerColumn[d] -
                       sample.y * m_inputs.grid.rows * m_inputs.geometry.cellsPerRow[d];
            factor *= scene::reconstructionFactor(m_image, cells[d] / m_layout.padded[int(d)]);
        }
        const auto read = m_reader.at(cells);
        Energies density{};
        for (std::size_t c = 0; c < 3; ++c)
            density[c] = m_densityUnit * factor * factor * std::norm(read[c].value);
        return density;
    }

    const render::FrameInputs &m_inputs;
    const scene::ImageDefinition &m_image;
    const fourier::SpectrumLayout &m_layout;
    render::SliceReader m_reader;
    double m_densityUnit;
    std::mt19937 m_random{7}; // NOLINT: the same for every slice
    std::uniform_real_distribution<double> m_even;
    std::vector<Sample> m_samples;
};

} // namespace

SliceEnergies sliceEnergies(const render::EngineSpectra &spectra, const render::FrameInputs &inputs,
                            const scene::Camera &camera, const scene::ImageDefinition &image) {
    return inputs.isEmpty() ? SliceEnergies()
                            : SliceSampler(spectra, inputs, camera, image).energies();
}

} // namespace pellucid::accuracy
