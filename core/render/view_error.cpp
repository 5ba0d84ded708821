// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/view_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/render/folded_tails.h"

namespace pellucid::render {

namespace {

// What coarse blocks and mean energies leave out, as energy; more of a field of a few samples,
// whose ghosts and whose rounding nothing averages.
constexpr double margin = 2.35, pointMargin = 3.8;
// Cells of a few samples' spectrum are alike and round alike: less averages out.
constexpr int fewSamples = 10;

// A picture that is periodic, in pixels about as large as blocks.
class CoarsePlane {
public:
    CoarsePlane(double widthMm, double heightMm, double pixelMm)
        : m_columns(std::clamp(int(widthMm / pixelMm), 1, 128)),
          m_rows(std::clamp(int(heightMm / pixelMm), 1, 128)), m_columnMm(widthMm / m_columns),
          m_rowMm(heightMm / m_rows), m_sums(std::size_t(m_columns) * m_rows) {}

    // Between the nearest four.
    void add(double u, double v, double amount) {
        const double x = u / m_columnMm, y = v / m_rowMm;
        const double column = std::floor(x), row = std::floor(y), right = x - column, up = y - row;
        const auto wrap = [](double n, int count) {
            const double left = std::fmod(n, count);
            return std::min(count - 1, int(left < 0.0 ? left + count : left));
        };
        const int c0 = wrap(column, m_columns), c1 = wrap(column + 1.0, m_columns),
                  r0 = wrap(row, m_rows), r1 = wrap(row + 1.0, m_rows);
        at(c0, r0) += amount * (1.0 - right) * (1.0 - up);
        at(c1, r0) += amount * right * (1.0 - up);
        at(c0, r1) += amount * (1.0 - right) * up;
        at(c1, r1) += amount * right * up;
    }

    // The integral of the square over a window about a place, of sums of what lies in a pixel.
    double energyIn(glm::dvec2 centre, glm::dvec2 size) const {
        double sum = 0.0;
        for (int row = 0; row < m_rows; ++row)
            for (int column = 0; column < m_columns; ++column)
                if (isWithin(column * m_columnMm - centre.x, m_columns * m_columnMm, size.x) &&
                    isWithin(row * m_rowMm - centre.y, m_rows * m_rowMm, size.y)) {
                    const double value = m_sums[std::size_t(row) * m_columns + column];
                    sum += value * value;
                }
        return sum / (m_columnMm * m_rowMm);
    }

    static bool isWithin(double off, double period, double size) {
        const double near = off - period * std::round(off / period);
        return std::abs(near) <= 0.5 * size;
    }

private:
    double &at(int column, int row) { return m_sums[std::size_t(row) * m_columns + column]; }

    int m_columns, m_rows;
    double m_columnMm, m_rowMm;
    std::vector<double> m_sums;
};

// The mean square of the differences of neighbours over twice the mean square, as `EnergySpread`
// has it of the field; of every few rows of a large picture.
struct PictureSums {
    double energy = 0.0, differences = 0.0;
};

PictureSums sumsOf(const ProjectionImage &picture, int channel) {
    const int step = std::max(1, picture.height / 512);
    PictureSums sums;
    const auto value = [&](int row, int column) {
        return double(picture.samples[(std::size_t(row) * picture.width + column) *
                                          std::size_t(picture.channels) +
                                      std::size_t(channel)]);
    };
    for (int row = 0; row < picture.height; row += step)
        for (int column = 0; column < picture.width; ++column) {
            const double here = value(row, column);
            const double across = here - value(row, std::max(0, column - 1)),
                         down = here - value(std::max(0, row - 1), column);
            sums.energy += here * here;
            sums.differences += across * across + down * down;
        }
    sums.energy *= step;
    sums.differences *= step;
    return sums;
}

} // namespace

ViewErrorModel::ViewErrorModel(const RenderPlan &plan, std::span<const FieldSummary> fields)
    : m_lattice(fields.front().lattice), m_room(plan.room), m_bound(plan.predictedError) {
    const fourier::SpectrumLayout &layout = plan.spectrum;
    const std::array<int, 3> padded{layout.padded.i, layout.padded.j, layout.padded.k};
    const std::array<int, 3> first{layout.box.lo.i, layout.box.lo.j, layout.box.lo.k};
    const volume::GridSize size = layout.box.size();
    std::array<std::vector<BlockRange>, 3> ranges;
    struct AxisBlock {
        double middle, before, after, inverse;
    };
    std::array<std::vector<AxisBlock>, 3> axes;
    for (int d = 0; d < 3; ++d) {
        const auto axis = std::size_t(d);
        const fourier::Kernel &kernel = layout.kernels[axis];
        ranges[axis] = blockRanges(size[d]);
        m_periods[axis] = double(padded[axis]) * m_lattice.step(d);
        m_kernelEnergy *= size[d] <= fewSamples ? 1.0 : kernel.energy();
        for (const BlockRange &range : ranges[axis]) {
            // Root mean squares over the block; the sign of its middle.
            double before = 0.0, after = 0.0, inverse = 0.0;
            const int samples = range.last - range.first + 1;
            for (int n = range.first; n <= range.last; ++n) {
                const double x = double(n - size[d] / 2) / padded[axis]; // NOLINT: whole
                const double h = kernel.apodisation(x);
                for (const int m : {-2, -1})
                    before += std::pow(kernel.apodisation(x + m) / h, 2) / samples;
                for (const int m : {1, 2})
                    after += std::pow(kernel.apodisation(x + m) / h, 2) / samples;
                inverse += 1.0 / (h * h) / samples;
            }
            const double middle = 0.5 * (range.first + range.last),
                         x = (middle - size[d] / 2) / padded[axis]; // NOLINT: whole
            axes[axis].push_back({middle + first[axis],
                                  std::copysign(std::sqrt(before), kernel.apodisation(x - 1.0)),
                                  std::copysign(std::sqrt(after), kernel.apodisation(x + 1.0)),
                                  size[d] <= fewSamples ? 1.0 : inverse});
        }
        m_blockMm = std::max(m_blockMm, double(size[d]) / double(ranges[axis].size()) *
                                            m_lattice.spacingMm(d));
    }
    std::map<std::array<std::uint8_t, 3>, std::uint32_t> known;
    const glm::dvec3 centre = m_lattice.center().mm;
    for (const FieldSummary &field : fields) {
        std::vector<Part> &parts = m_fields.emplace_back();
        for (const FieldBlock &block : field.energy.blocks) {
            const auto [it, isNew] = known.try_emplace(block.at, std::uint32_t(m_blocks.size()));
            if (isNew) {
                const AxisBlock &i = axes[0][block.at[0]], &j = axes[1][block.at[1]],
                                &k = axes[2][block.at[2]];
                Block made;
                made.fromCentreMm =
                    m_lattice.patient(volume::VoxelPoint{{i.middle, j.middle, k.middle}}).mm -
                    centre;
                made.ghosts = {float(i.before), float(i.after),  float(j.before),
                               float(j.after),  float(k.before), float(k.after)};
                made.inverse = float(i.inverse * j.inverse * k.inverse);
                m_blocks.push_back(made);
            }
            parts.push_back({it->second, float(block.mass * field.energy.massMm3),
                             float(block.energy * field.energy.energyMm3)});
        }
        m_spreads.push_back(field.energy.spread);
        m_depthRadiusMm = field.depthRadiusMm.value_or(m_lattice.radiusMm());
    }
    m_rounding = layout.storage == fourier::Storage::binary16 ? 2.1e-4 : 3e-7;
}

ViewErrorModel::Energies ViewErrorModel::channelEnergies(const ProjectionImage &picture,
                                                         int channel, const Camera &camera,
                                                         const ImageDefinition &image,
                                                         std::span<const double> weights,
                                                         const shading::DepthCue &cue) const {
    const SliceGrid grid = sliceGrid(camera, m_room, m_lattice, image);
    const glm::dmat3 axes = camera.axes();
    const double pixel = camera.pixelMm;
    const PictureSums sums = sumsOf(picture, channel);
    Energies energies{sums.energy * pixel * pixel, 0.0};
    // All fields of the channel as one.
    std::vector<double> mass(m_blocks.size()), energy(m_blocks.size());
    for (std::size_t f = 0; f < m_fields.size(); ++f)
        for (const Part &part : m_fields[f]) {
            mass[part.block] += weights[f] * double(part.mass);
            energy[part.block] += weights[f] * weights[f] * double(part.energy);
        }
    const auto value = cue.isActive() ? shading::cueFunction(cue)
                                      : std::function<double(double)>([](double) { return 1.0; });
    const double coarseMm = std::max({m_blockMm, grid.columns * pixel / 128.0});
    CoarsePlane plain(grid.columns * pixel, grid.rows * pixel, coarseMm),
        ghosts(grid.columns * pixel, grid.rows * pixel, coarseMm);
    const glm::dvec2 window(camera.width * pixel, camera.height * pixel);
    double fine = 0.0, all = 0.0, inverse = 0.0; // energies
    for (std::size_t n = 0; n < m_blocks.size(); ++n) {
        if (energy[n] == 0.0)
            continue;
        const Block &block = m_blocks[n];
        const auto add = [&](CoarsePlane &plane, const glm::dvec3 &at, double amplitude) {
            const glm::dvec3 seen = glm::transpose(axes) * at;
            const double weight = amplitude * value(seen.z / m_depthRadiusMm);
            plane.add(seen.x - camera.panMm.x, seen.y - camera.panMm.y, weight * mass[n]);
            const bool isInside =
                CoarsePlane::isWithin(seen.x - camera.panMm.x, grid.columns * pixel, window.x) &&
                CoarsePlane::isWithin(seen.y - camera.panMm.y, grid.rows * pixel, window.y);
            return isInside ? weight * weight * energy[n] : 0.0;
        };
        all += add(plain, block.fromCentreMm, 1.0);
        inverse += double(block.inverse) * energy[n];
        for (std::size_t d = 0; d < 3; ++d) {
            fine += add(ghosts, block.fromCentreMm - m_periods[d], double(block.ghosts[2 * d]));
            fine += add(ghosts, block.fromCentreMm + m_periods[d], double(block.ghosts[2 * d + 1]));
        }
    }
    double total = 0.0;
    for (const double e : energy)
        total += e;
    if (!(energies.image > 0.0) || !(total > 0.0))
        return energies;
    const double coherent = ghosts.energyIn({0.0, 0.0}, window);
    // What blocks do not show, edges and noise, has ghosts as its energy lies.
    const double unseen =
        std::max(0.05 * energies.image, energies.image - plain.energyIn({0.0, 0.0}, window));
    const double detail = all > 0.0 ? unseen * fine / all : 0.0;
    const double rounding =
        m_rounding * m_rounding * m_kernelEnergy * inverse / total * energies.image;
    // Tails come from what the picture has at the edge of its band.
    const double roughness = std::min(1.0, sums.differences / std::max(4.0 * sums.energy, 1e-300));
    double folded = 0.0;
    for (const auto &spread : m_spreads)
        folded = std::max(folded, foldedTailEnergy(*spread, image.rollOff, pixel, grid.columns,
                                                   camera.width, camera.panMm.x / pixel) +
                                      foldedTailEnergy(*spread, image.rollOff, pixel, grid.rows,
                                                       camera.height, camera.panMm.y / pixel));
    double concentration = 0.0;
    for (const auto &spread : m_spreads)
        concentration = std::max(concentration, spread->concentration);
    const double slack = margin + (pointMargin - margin) * std::min(1.0, concentration);
    energies.error = slack * (coherent + detail + rounding) + roughness * folded * energies.image;
    return energies;
}

double ViewErrorModel::relativeError(const ProjectionImage &picture, const Camera &camera,
                                     const ImageDefinition &image,
                                     std::span<const ChannelShares> shares,
                                     const shading::Shading &shading) const {
    if (!shading.lights.empty() || picture.samples.empty())
        return m_bound;
    double energy = 0.0, error = 0.0;
    std::vector<double> weights(m_fields.size());
    for (int channel = 0; channel < picture.channels; ++channel) {
        for (std::size_t f = 0; f < weights.size(); ++f)
            weights[f] = shares[f][std::size_t(channel)];
        const Energies of = channelEnergies(picture, channel, camera, image, weights, shading.cue);
        energy += of.image;
        error += of.error;
    }
    const double estimate = energy > 0.0 ? std::sqrt(error / energy) : 0.0;
    // The bound is of a picture of the whole.
    double share = 1.0;
    for (const auto &spread : m_spreads)
        share = std::min(share, shareInImage(camera, *spread));
    return share < 1.0 ? estimate : std::min(m_bound, estimate);
}

} // namespace pellucid::render
