// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/narrowing_error.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/render/slice_reader.h"

namespace pellucid::accuracy {

namespace {

constexpr int samples = 1000;
// This share of them is spread evenly over the tiles: some tiles may have more error than was
// thought when their widths were chosen.
constexpr double evenShare = 0.5;
// The sample's own standard error is added so many times.
constexpr double standardErrors = 2.0;

// A frequency of a slice, and how many frequencies it stands for.
struct Sample {
    int column = 0, row = 0, width = 0;
    double count = 0.0;
};

// Frequencies of the tiles of a map, at even steps through the sum of their shares.
std::vector<Sample> sampled(const plan::WidthMap &map) {
    constexpr int tileColumns = plan::WidthMap::tileColumns, tileRows = plan::WidthMap::tileRows;
    std::mt19937 random(5); // NOLINT: the same in every run
    std::uniform_real_distribution<double> even;
    const double all = std::accumulate(map.errors.begin(), map.errors.end(), 0.0);
    const auto count = std::count_if(map.errors.begin(), map.errors.end(),
                                     [](float error) { return error > 0.0F; });
    std::vector<Sample> result;
    if (!(all > 0.0))
        return result;
    const double step = 1.0 / samples;
    double next = even(random) * step, before = 0.0;
    for (std::size_t tile = 0; tile < map.errors.size(); ++tile) {
        if (!(map.errors[tile] > 0.0F))
            continue;
        const double share = (1.0 - evenShare) * map.errors[tile] / all + evenShare / double(count);
        for (; next < before + share; next += step) {
            const int perStrip = 2 * map.tiles, strip = int(tile) / perStrip,
                      row = int(tile) % perStrip - map.tiles;
            result.push_back({strip * tileColumns + int(even(random) * tileColumns),
                              row * tileRows + int(even(random) * tileRows), map.widths[tile],
                              double(tileColumns) * tileRows / (samples * share)});
        }
        before += share;
    }
    return result;
}

} // namespace

std::array<double, 3> narrowingEnergies(const render::EngineSpectra &spectra,
                                        const render::FrameInputs &inputs,
                                        const scene::Camera &camera,
                                        const scene::ImageDefinition &image) {
    std::array<double, 3> energies{};
    if (!inputs.widths)
        return energies;
    const render::SliceReader reader(spectra, inputs.mixing, inputs.shading,
                                     render::SliceReader::Rounding::unknown);
    const plan::SlicePlane plane = render::slicePlane(camera, inputs.grid, inputs.geometry);
    const fourier::SpectrumLayout &layout = spectra.fields.front()->layout();
    const std::vector<Sample> chosen = sampled(*inputs.widths);
    std::vector<std::array<double, 3>> errors(chosen.size());
    tbb::parallel_for(std::size_t(0), chosen.size(), [&](std::size_t n) {
        const Sample &sample = chosen[n];
        const double radius =
            std::hypot(2.0 * sample.column / plane.columns, 2.0 * sample.row / plane.rows);
        if (!(radius < 1.0))
            return;
        std::array<double, 3> cells{};
        double factor = scene::rollOffFactor(image.rollOff, radius);
        for (std::size_t d = 0; d < 3; ++d) {
            cells[d] = sample.column * plane.perColumn[d] + sample.row * plane.perRow[d];
            factor *= scene::reconstructionFactor(image, cells[d] / layout.padded[int(d)]);
        }
        const auto exact = reader.at(cells);
        const auto narrow = sample.width > 0 ? reader.at(cells, inputs.kernels->of(sample.width))
                                             : std::array<render::SliceReader::Read, 3>{};
        for (std::size_t c = 0; c < 3; ++c)
            errors[n][c] =
                sample.count * factor * factor * std::norm(narrow[c].value - exact[c].value);
    });
    // Both halves of the plane.
    const double area = 2.0 * plane.columnPerMm * plane.rowPerMm;
    std::array<double, 3> squares{};
    for (const std::array<double, 3> &error : errors)
        for (std::size_t c = 0; c < 3; ++c) {
            energies[c] += area * error[c];
            squares[c] += area * area * error[c] * error[c];
        }
    for (std::size_t c = 0; c < 3; ++c)
        energies[c] +=
            standardErrors * std::sqrt(squares[c]) + inputs.widths->unmeasuredEnergy / 3.0;
    return energies;
}

} // namespace pellucid::accuracy
