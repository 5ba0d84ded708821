// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/central_rounding.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "core/render/frame_geometry.h"
#include "core/render/frame_mixing.h"

namespace pellucid::accuracy {

namespace {

using Complex = std::complex<double>;
using fourier::Spectrum;

constexpr std::size_t maxTaps = 2 * Spectrum::roundingReach;
using Taps = std::array<std::array<double, maxTaps>, 3>;

// A value read from a spectrum, and its rounding error.
struct Read {
    Complex value = 0.0, error = 0.0;
    Read &operator+=(const Read &other) {
        value += other.value;
        error += other.error;
        return *this;
    }
};
Read operator*(const Complex &factor, const Read &read) {
    return {factor * read.value, factor * read.error};
}

class CentralSlices {
public:
    CentralSlices(const render::EngineParts &engine, const scene::Camera &camera,
                  const plan::SliceGrid &grid, const shading::Shading &shading)
        : m_engine(engine), m_spectrum(*engine.spectra.fields.front()),
          m_layout(m_spectrum.layout()), m_geometry(camera, grid, m_spectrum),
          m_slices(shading::sliceShading(shading, camera.axes(), engine.spectra.scale)),
          m_mixing(engine.spectra, engine.channelWeights, m_slices, shading.isGrey()),
          m_frameShading(render::frameShading(m_slices, m_mixing, m_spectrum, m_geometry.toWrap,
                                              camera.axes()[2], engine.spectra.scale.stepMm)) {
        if (m_frameShading.cued)
            m_moments.emplace(render::momentKernels(m_layout));
    }

    CentralEnergies energies(const scene::Camera &camera, const plan::SliceGrid &grid) const {
        const auto &across = m_geometry.cellsPerColumn, &down = m_geometry.cellsPerRow;
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
                waves.images.push_back(isWithinReach(at) ? slicesAt(at, row == 0 && column == 0)
                                                         : std::array<Read, 3>{});
            }
        CentralEnergies energies = energiesIn(camera, grid, waves);
        energies.cellRounding = roundingOfCells();
        return energies;
    }

private:
    // Slices read whole kernel footprints.
    double reach() const { return Spectrum::roundingReach - 0.5 * m_layout.width(); }

    double roundingOfCells() const {
        constexpr int reach = Spectrum::roundingReach;
        double energy = 0.0, error = 0.0;
        for (const render::FrameSource &source : m_mixing.sources)
            for (int r = -reach; r <= reach; ++r)
                for (int q = -reach; q <= reach; ++q)
                    for (int p = 0; p <= reach; ++p) {
                        const Read cell = readCell(spectrumOf(source), p, q, r);
                        energy += std::norm(cell.value);
                        error += std::norm(cell.error);
                    }
        return energy > 0.0 ? error / energy : 0.0;
    }

    const Spectrum &spectrumOf(const render::FrameSource &source) const {
        return *(source.kind == render::FrameKind::field
                     ? m_engine.spectra.fields[source.field]
                     : m_engine.spectra.gradients[source.field]);
    }

    bool isWithinReach(const std::array<double, 3> &at) const {
        for (int t = 0; t < m_frameShading.termCount; ++t)
            for (std::size_t d = 0; d < 3; ++d)
                if (std::abs(at[d] + m_frameShading.terms[std::size_t(t)].cells[d]) > reach())
                    return false;
        return true;
    }

    // The waves of a slice's central cells, up to this many columns and rows on both sides. Zero
    // where the slice reads cells that are not kept.
    struct Waves {
        int columns, rows;
        std::vector<std::array<Read, 3>> images; ///< by row and column, then by channel
    };

    std::array<Read, 3> slicesAt(const std::array<double, 3> &at, bool isZero) const {
        std::array<Read, 3> image{};
        for (int t = 0; t < m_frameShading.termCount; ++t)
            addTerm(at, t, isZero, image);
        if (m_mixing.channels > 1)
            return image;
        // A single image is colored afterwards.
        const Read grey = image[0];
        for (std::size_t c = 0; c < 3; ++c)
            image[c] = Complex(m_mixing.color[c]) * grey;
        return image;
    }

    // The waves are slow, so a few points of the picture are enough for their energy in it.
    CentralEnergies energiesIn(const scene::Camera &camera, const plan::SliceGrid &grid,
                               const Waves &waves) const {
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
                                   m_geometry.turnsPerColumn, xPoints),
                   down = phases(waves.rows, camera.height, grid.rows, m_geometry.turnsPerRow,
                                 yPoints);
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
                     unit = m_geometry.cellArea * m_geometry.cellArea * pointMm2;
        for (std::size_t c = 0; c < 3; ++c) {
            sum.image[c] *= unit;
            sum.error[c] *= unit;
        }
        return sum;
    }

    // See FrameShading.
    void addTerm(const std::array<double, 3> &central, int term, bool isZero,
                 std::array<Read, 3> &images) const {
        const render::FrameShading::Term &shadingTerm = m_frameShading.terms[std::size_t(term)];
        const Complex weight(shadingTerm.weight);
        std::array<double, 3> at{};
        for (std::size_t d = 0; d < 3; ++d)
            at[d] = central[d] + shadingTerm.cells[d];
        // Plain and cued, by kind (field, gradient) and sum.
        std::array<std::array<std::array<Read, 3>, 2>, 2> reads{};
        for (const render::FrameSource &source : m_mixing.sources) {
            const auto kind = std::size_t(source.kind);
            const Spectrum &spectrum = spectrumOf(source);
            auto [plain, cued] = readAt(spectrum, at);
            // The sum at frequency 0 is known exactly.
            if (isZero && term == 0)
                plain.error = cued.error = 0.0;
            for (std::size_t c = 0; c < std::size_t(m_mixing.sums); ++c) {
                const double share =
                    double(source.channelWeights[c]) * m_mixing.unit / spectrum.unit();
                reads[0][kind][c] += share * plain;
                reads[1][kind][c] += share * cued;
            }
        }
        for (std::size_t c = 0; c < std::size_t(m_mixing.channels); ++c) {
            const render::FrameShading::Image &image = m_frameShading.images[c];
            const std::size_t sum = m_mixing.sums == 1 ? 0 : c;
            double gradient = 0.0, excess = 0.0;
            for (std::size_t d = 0; d < 3; ++d) {
                const double turn = 2.0 * std::numbers::pi * at[d] / m_layout.padded[int(d)];
                gradient += image.gradient[d] * std::sin(turn);
                excess += image.excess[d] * std::cos(turn);
            }
            Read slice = Complex(image.ambient, gradient) * reads[1][0][sum];
            slice += Complex(-excess) * reads[0][0][sum];
            slice += Complex(image.magnitude) * reads[1][1][sum];
            images[c] += weight * slice;
        }
    }

    std::array<Read, 2> readAt(const Spectrum &spectrum, const std::array<double, 3> &at) const {
        const int width = m_layout.width();
        std::array<int, 3> first{};
        Taps taps{}, moments{};
        for (std::size_t d = 0; d < 3; ++d) {
            first[d] = int(std::ceil(at[d] - 0.5 * width));
            for (int tap = 0; tap < width; ++tap) {
                const double away = first[d] + tap - at[d];
                taps[d][std::size_t(tap)] = m_layout.kernels[d].value(away);
                if (m_moments)
                    moments[d][std::size_t(tap)] =
                        m_frameShading.perMoment[d] * (*m_moments)[d].value(away);
            }
        }
        Read plain, moment;
        for (std::size_t r = 0; r < std::size_t(width); ++r)
            for (std::size_t q = 0; q < std::size_t(width); ++q)
                for (std::size_t p = 0; p < std::size_t(width); ++p) {
                    const Read cell =
                        readCell(spectrum, first[0] + int(p), first[1] + int(q), first[2] + int(r));
                    const double x = taps[0][p], y = taps[1][q], z = taps[2][r];
                    plain += Complex(x * y * z) * cell;
                    if (m_moments)
                        moment += Complex(moments[0][p] * y * z + x * moments[1][q] * z +
                                          x * y * moments[2][r]) *
                                  cell;
                }
        // The odd kernel yields -i times the field times its distance.
        Read cued = Complex(m_frameShading.base) * plain;
        cued += Complex(0.0, 1.0) * moment;
        return {plain, m_frameShading.cued ? cued : plain};
    }

    static Read readCell(const Spectrum &spectrum, int p, int q, int r) {
        if (p < 0) {
            const Read mirrored = readCell(spectrum, -p, -q, -r);
            return {std::conj(mirrored.value), std::conj(mirrored.error)};
        }
        return {spectrum.value(p, q, r), spectrum.rounding(p, q, r)};
    }

    const render::EngineParts &m_engine;
    const Spectrum &m_spectrum;
    const fourier::SpectrumLayout &m_layout;
    render::FrameGeometry m_geometry;
    shading::SliceShading m_slices;
    render::Mixing m_mixing;
    render::FrameShading m_frameShading;
    std::optional<render::MomentKernels> m_moments;
};

} // namespace

CentralEnergies centralEnergies(const render::EngineParts &engine, const scene::Camera &camera,
                                const plan::SliceGrid &grid, const shading::Shading &shading) {
    const auto keepsRounding = [](const auto &spectra) {
        return std::all_of(spectra.begin(), spectra.end(),
                           [](const auto &spectrum) { return spectrum->keepsRounding(); });
    };
    if (!keepsRounding(engine.spectra.fields) || !keepsRounding(engine.spectra.gradients) ||
        std::size_t(engine.spectra.fields.front()->layout().width()) >= maxTaps)
        return {};
    if (std::all_of(
            engine.channelWeights.begin(), engine.channelWeights.end(),
            [](const render::ChannelWeights &share) { return share == render::ChannelWeights{}; }))
        return {}; // nothing is shown
    shading::Shading activeShading = shading;
    if (engine.spectra.gradients.empty())
        activeShading.lights.clear();
    return CentralSlices(engine, camera, grid, activeShading).energies(camera, grid);
}

} // namespace pellucid::accuracy
