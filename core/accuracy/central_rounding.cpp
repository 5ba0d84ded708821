// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/central_rounding.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/render/slice_reader.h"

namespace pellucid::accuracy {

namespace {

using Complex = std::complex<double>;
using fourier::Spectrum;

constexpr std::size_t maxTaps = 2 * Spectrum::roundingReach;

using Read = render::SliceReader::Read;

class CentralSlices {
public:
    CentralSlices(const render::EngineSpectra &spectra, const render::FrameInputs &inputs)
        : m_inputs(inputs), m_layout(spectra.fields.front()->layout()),
          m_reader(spectra, inputs.mixing, inputs.shading, render::SliceReader::Rounding::read) {}

    CentralEnergies energies(const scene::Camera &camera) const {
        const plan::SliceGrid &grid = m_inputs.grid;
        const auto &across = m_inputs.geometry.cellsPerColumn,
                   &down = m_inputs.geometry.cellsPerRow;
        const auto most = [&](const std::array<double, 3> &step, int count) {
            double largest = 0.0;
            for (const double component : step)
                largest = std::max(largest, std::abs(component));
            return std::min(count / 2 - 1, int(reach() / largest) + 1);
        };
        Waves waves{most(across, grid.columns), most(down, grid.rows), {}};
        for (int row = -waves.rows; row <= waves.rows; ++row)
            for (int column = -waves.columns; column <= waves.columns; ++column) {
                std::array<double, 3> at{};
                for (std::size_t d = 0; d < 3; ++d)
                    at[d] = column * across[d] + row * down[d];
                waves.images.push_back(isWithinReach(at) ? m_reader.at(at) : std::array<Read, 3>{});
            }
        CentralEnergies energies = energiesIn(camera, waves);
        energies.cellRounding = roundingOfCells();
        return energies;
    }

private:
    // Slices read whole kernel footprints.
    double reach() const { return Spectrum::roundingReach - 0.5 * m_layout.width(); }

    double roundingOfCells() const {
        constexpr int reach = Spectrum::roundingReach;
        double energy = 0.0, error = 0.0;
        for (const render::FrameSource &source : m_inputs.mixing.sources)
            for (int r = -reach; r <= reach; ++r)
                for (int q = -reach; q <= reach; ++q)
                    for (int p = 0; p <= reach; ++p) {
                        const Read cell = m_reader.cell(source, {p, q, r});
                        energy += std::norm(cell.value);
                        error += std::norm(cell.error);
                    }
        return energy > 0.0 ? error / energy : 0.0;
    }

    bool isWithinReach(const std::array<double, 3> &at) const {
        for (int t = 0; t < m_inputs.shading.termCount; ++t)
            for (std::size_t d = 0; d < 3; ++d)
                if (std::abs(at[d] + m_inputs.shading.terms[std::size_t(t)].cells[d]) > reach())
                    return false;
        return true;
    }

    // The waves of a slice's central cells, up to this many columns and rows on both sides. Zero
    // where the slice reads cells that are not kept.
    struct Waves {
        int columns, rows;
        std::vector<std::array<Read, 3>> images; ///< by row and column, then by channel
    };

    // The waves are slow, so a few points of the picture are enough for their energy in it.
    CentralEnergies energiesIn(const scene::Camera &camera, const Waves &waves) const {
        const plan::SliceGrid &grid = m_inputs.grid;
        // The energy's waves are twice as fast. A picture of several padded periods contains many.
        const auto pointsFor = [](int most, int side, int period) {
            return std::size_t(std::max(24.0, std::ceil(4.0 * most * side / period)));
        };
        const std::size_t xPoints = pointsFor(waves.columns, camera.width, grid.columns),
                          yPoints = pointsFor(waves.rows, camera.height, grid.rows);
        // The phases of all waves of an axis, from -waves to waves, at each point.
        const auto phases = [](int most, int side, int period, double offset, std::size_t points) {
            std::vector<Complex> values;
            for (std::size_t n = 0; n < points; ++n)
                for (int wave = -most; wave <= most; ++wave)
                    values.push_back(std::polar(
                        1.0, 2.0 * std::numbers::pi * wave *
                                 (offset + (double(n) + 0.5) * side / double(points) / period)));
            return values;
        };
        const auto across = phases(waves.columns, camera.width, grid.columns,
                                   m_inputs.geometry.turnsPerColumn, xPoints),
                   down = phases(waves.rows, camera.height, grid.rows,
                                 m_inputs.geometry.turnsPerRow, yPoints);
        const std::size_t columns = 2 * std::size_t(waves.columns) + 1,
                          rows = 2 * std::size_t(waves.rows) + 1;
        CentralEnergies sum;
        std::vector<std::array<Read, 3>> summed(rows);
        for (std::size_t x = 0; x < xPoints; ++x) {
            for (std::size_t row = 0; row < rows; ++row) {
                summed[row] = {};
                for (std::size_t column = 0; column < columns; ++column)
                    for (std::size_t c = 0; c < 3; ++c)
                        summed[row][c] +=
                            across[x * columns + column] * waves.images[row * columns + column][c];
            }
            for (std::size_t y = 0; y < yPoints; ++y) {
                std::array<Read, 3> here{};
                for (std::size_t row = 0; row < rows; ++row)
                    for (std::size_t c = 0; c < 3; ++c)
                        here[c] += down[y * rows + row] * summed[row][c];
                for (std::size_t c = 0; c < 3; ++c) {
                    sum.image[c] += std::norm(here[c].value);
                    sum.error[c] += std::norm(here[c].error);
                }
            }
        }
        const double pixel = camera.pixelMm,
                     pointMm2 =
                         pixel * pixel * camera.width * camera.height / double(xPoints * yPoints),
                     unit = m_inputs.geometry.cellArea * m_inputs.geometry.cellArea * pointMm2;
        for (std::size_t c = 0; c < 3; ++c) {
            sum.image[c] *= unit;
            sum.error[c] *= unit;
            for (const std::array<Read, 3> &wave : waves.images)
                sum.slice[c] += std::norm(wave[c].value) * m_inputs.geometry.cellArea;
        }
        return sum;
    }

    const render::FrameInputs &m_inputs;
    const fourier::SpectrumLayout &m_layout;
    render::SliceReader m_reader;
};

} // namespace

CentralEnergies centralEnergies(const render::EngineSpectra &spectra,
                                const render::FrameInputs &inputs, const scene::Camera &camera) {
    const auto keepsRounding = [](const auto &all) {
        return std::all_of(all.begin(), all.end(),
                           [](const auto &spectrum) { return spectrum->keepsRounding(); });
    };
    if (inputs.isEmpty() || !keepsRounding(spectra.fields) || !keepsRounding(spectra.gradients) ||
        std::size_t(spectra.fields.front()->layout().width()) >= maxTaps)
        return {};
    return CentralSlices(spectra, inputs).energies(camera);
}

} // namespace pellucid::accuracy
