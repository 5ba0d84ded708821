// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/render/view_error.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/render/folded_tails.h"
#include "core/shading/slice_shading.h"

namespace pellucid::render {

namespace {

// What coarse blocks and mean energies leave out, as energy: of ghosts, block by block and beyond
// blocks; of cells that round by chance, more of a field of a few samples, which nothing averages;
// of those whose rounding is known; of tails. Fitted to 600 random pictures, and not to those that
// the tests and the bench's suite `pictures` make.
constexpr double coherentMargin = 2.7, detailMargin = 2.6, restMargin = 2.0, pointMargin = 8.5,
                 centralMargin = 2.6, tailMargin = 12.0;
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
    double energy = 0.0, across = 0.0, down = 0.0;
};

PictureSums sumsOf(const ProjectionImage &picture, int channel) {
    const int step = std::max(1, picture.height / 512);
    PictureSums sums;
    const auto value = [&](int row, int column) {
        return double(picture.samples[(std::size_t(row) * picture.width + column) *
                                          std::size_t(picture.channels) +
                                      std::size_t(channel)]);
    };
    // Fourth differences have sin^8(pi f) of the energy at a frequency f: next to nothing but what
    // lies at the edge of the band. Of white noise it is 35/128.
    constexpr std::array<double, 5> factors{1.0 / 16, -4.0 / 16, 6.0 / 16, -4.0 / 16, 1.0 / 16};
    for (int row = 0; row < picture.height; row += step)
        for (int column = 0; column < picture.width; ++column) {
            double across = 0.0, down = 0.0;
            for (int n = 0; n < int(factors.size()); ++n) {
                across += factors[std::size_t(n)] *
                          value(row, std::clamp(column + n - 2, 0, picture.width - 1));
                down += factors[std::size_t(n)] *
                        value(std::clamp(row + n - 2, 0, picture.height - 1), column);
            }
            const double here = value(row, column);
            sums.energy += here * here;
            sums.across += across * across * (128.0 / 35.0);
            sums.down += down * down * (128.0 / 35.0);
        }
    sums.energy *= step;
    sums.across *= step;
    sums.down *= step;
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

ViewErrorModel::Energies ViewErrorModel::centralEnergies(const Camera &camera,
                                                         const SliceGrid &grid,
                                                         std::span<const Weight> weights,
                                                         const EngineParts &engine) const {
    std::vector<const fourier::Spectrum *> spectra;
    for (const auto *const of : {&engine.spectra.fields, &engine.spectra.gradients})
        for (const auto &spectrum : *of)
            spectra.push_back(spectrum.get());
    const fourier::SpectrumLayout &layout = spectra.front()->layout();
    const double half = 0.5 * layout.width(), reach = fourier::Spectrum::roundingReach - half;
    const glm::dmat3 axes = camera.axes();
    const double column = 1.0 / (grid.columns * camera.pixelMm),
                 row = 1.0 / (grid.rows * camera.pixelMm);
    // Cells along each axis for a step across and down the slice.
    glm::dvec3 across(0.0), down(0.0);
    for (int d = 0; d < 3; ++d) {
        const double cells = layout.padded[d];
        across[d] = cells * column * glm::dot(m_lattice.step(d), axes[0]);
        down[d] = cells * row * glm::dot(m_lattice.step(d), axes[1]);
    }
    Energies central;
    const int columns = std::min(grid.columns / 2 - 1, int(reach / glm::length(across)) + 1),
              rows = std::min(grid.rows / 2 - 1, int(reach / glm::length(down)) + 1);
    for (int m = -rows; m <= rows; ++m)
        for (int n = -columns; n <= columns; ++n) {
            const glm::dvec3 at = double(n) * across + double(m) * down;
            if (std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) > reach)
                continue;
            std::complex<double> value = 0.0, error = 0.0;
            const glm::ivec3 first(glm::ceil(at - half));
            for (int r = first.z; r < at.z + half; ++r)
                for (int q = first.y; q < at.y + half; ++q)
                    for (int p = first.x; p < at.x + half; ++p) {
                        const double tap = layout.kernels[0].value(p - at.x) *
                                           layout.kernels[1].value(q - at.y) *
                                           layout.kernels[2].value(r - at.z);
                        for (std::size_t f = 0; f < spectra.size() && f < weights.size(); ++f) {
                            const bool isHalf = p >= 0;
                            const int sign = isHalf ? 1 : -1;
                            const std::complex<double> cell =
                                spectra[f]->value(sign * p, sign * q, sign * r);
                            value += weights[f].mass * tap * (isHalf ? cell : std::conj(cell));
                            error += weights[f].mass * tap * spectra[f]->rounding(p, q, r);
                        }
                    }
            central.image += std::norm(value) * column * row;
            central.error += std::norm(error) * column * row;
        }
    return central;
}

ViewErrorModel::Energies
ViewErrorModel::channelEnergies(const ProjectionImage &picture, int channel, const Camera &camera,
                                const ImageDefinition &image, std::span<const Weight> weights,
                                const EngineParts &engine, const shading::Shading &shading) const {
    const shading::DepthCue &cue = shading.cue;
    const SliceGrid grid = sliceGrid(camera, m_room, m_lattice, image);
    const glm::dmat3 axes = camera.axes();
    const double pixel = camera.pixelMm;
    const PictureSums sums = sumsOf(picture, channel);
    Energies energies{sums.energy * pixel * pixel, 0.0};
    // All fields of the channel as one.
    std::vector<double> mass(m_blocks.size()), energy(m_blocks.size());
    for (std::size_t f = 0; f < m_fields.size(); ++f)
        for (const Part &part : m_fields[f]) {
            mass[part.block] += weights[f].mass * double(part.mass);
            energy[part.block] += weights[f].energy * double(part.energy);
        }
    const auto value = cue.isActive() ? shading::cueFunction(cue)
                                      : std::function<double(double)>([](double) { return 1.0; });
    const double coarseMm = std::max({m_blockMm, grid.columns * pixel / 128.0});
    CoarsePlane plain(grid.columns * pixel, grid.rows * pixel, coarseMm),
        ghosts(grid.columns * pixel, grid.rows * pixel, coarseMm);
    const glm::dvec2 window(camera.width * pixel, camera.height * pixel);
    // Energies: of ghosts and blocks in the picture, of blocks anywhere, of what tails leave.
    double fine = 0.0, all = 0.0, sum = 0.0, inverse = 0.0, tailsAcross = 0.0, tailsDown = 0.0;
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
        const glm::dvec3 seen = glm::transpose(axes) * block.fromCentreMm;
        const double weight = value(seen.z / m_depthRadiusMm), here = weight * weight * energy[n];
        sum += here;
        tailsAcross += here * tailInImage(image.rollOff, grid.columns, camera.width,
                                          (seen.x - camera.panMm.x) / pixel);
        tailsDown += here * tailInImage(image.rollOff, grid.rows, camera.height,
                                        (seen.y - camera.panMm.y) / pixel);
        inverse += double(block.inverse) * energy[n];
        for (std::size_t d = 0; d < 3; ++d) {
            fine += add(ghosts, block.fromCentreMm - m_periods[d], double(block.ghosts[2 * d]));
            fine += add(ghosts, block.fromCentreMm + m_periods[d], double(block.ghosts[2 * d + 1]));
        }
    }
    double total = 0.0; // without the cue
    for (const double e : energy)
        total += e;
    if (!(energies.image > 0.0) || !(sum > 0.0))
        return energies;
    const double coherent = ghosts.energyIn({0.0, 0.0}, window);
    // A part of the picture suffers from what lies beside it as well: from the mass of its blocks,
    // and from samples that have nothing to do with each other.
    const glm::dvec2 everything(grid.columns * pixel, grid.rows * pixel);
    const double seen = plain.energyIn({0.0, 0.0}, window), outside = std::max(0.0, sum - all);
    const double cellMm3 = m_lattice.cellVolumeMm3(),
                 lengthMm = cellMm3 / std::max(std::pow(cellMm3, 2.0 / 3.0), pixel * pixel);
    const double beside =
        std::max(0.0, plain.energyIn({0.0, 0.0}, everything) - seen) + outside * lengthMm;
    // What blocks do not show, edges and noise, has ghosts as its energy lies.
    const double unseen = std::max(0.05 * energies.image, energies.image - seen);
    const double detail = fine * (unseen + outside * lengthMm) / sum;
    // Rounding is all over the period.
    double shadowMm2 = 0.0, concentration = 0.0;
    for (const auto &spread : m_spreads) {
        shadowMm2 = std::max(shadowMm2, spread->shadowMm2);
        concentration = std::max(concentration, spread->concentration);
    }
    const double part = std::min(1.0, 4.0 * window.x * window.y / shadowMm2);
    // A cue weighs what rounding has made by the depth that it seems to come from.
    const Energies central =
        cue.isActive() ? Energies() : centralEnergies(camera, grid, weights, engine);
    const double whole = energies.image + beside,
                 rest = m_rounding * m_rounding * m_kernelEnergy * inverse / total *
                        std::max(0.0, whole - central.image) * part,
                 centralError =
                     central.error * std::min(1.0, 1.5 * window.x * window.y / shadowMm2);
    // Tails come from what the picture has at the edge of its band, along each of its axes.
    const auto rough = [&](double differences) {
        return std::min(1.0, differences / std::max(sums.energy, 1e-300));
    };
    const double folded = (rough(sums.across) * tailsAcross + rough(sums.down) * tailsDown) / sum;
    energies.isWhole = outside < 1e-9 * sum;
    // Under light a sample's gradient is several.
    const double few = shading.isLit() ? 0.0 : pointMargin * std::min(1.0, 2.5 * concentration);
    energies.error = coherentMargin * coherent + detailMargin * detail + (restMargin + few) * rest +
                     centralMargin * centralError + tailMargin * folded * whole;
    return energies;
}

double ViewErrorModel::relativeError(const ProjectionImage &picture, const Camera &camera,
                                     const ImageDefinition &image, const EngineParts &engine,
                                     const shading::Shading &shading) const {
    if (picture.samples.empty())
        return m_bound;
    const std::vector<ChannelShares> &shares = engine.shares;
    // Without light the weights are the same; R and the step do not matter to them.
    const shading::SliceShading slices = shading::sliceShading(shading, camera.axes(), {});
    const bool isLit = shading.isLit();
    double energy = 0.0, error = 0.0;
    bool isWhole = true; // what the plan's bound is of
    std::vector<Weight> weights(m_fields.size());
    for (int channel = 0; channel < picture.channels; ++channel) {
        const auto c = std::size_t(channel);
        const shading::SliceShading::Channel &light = slices.channels[c];
        for (std::size_t f = 0; f < weights.size(); ++f) {
            // Behind the fields are their gradients, if they were prepared for light.
            const bool isGradient = f >= shares.size();
            const double share = shares[isGradient ? f - shares.size() : f][c];
            if (!isLit || !isGradient) {
                const double weight = isGradient ? 0.0 : share * (isLit ? light.ambient : 1.0);
                weights[f] = {weight, weight * weight};
                continue;
            }
            // Directed light sees a third of the gradient's energy, and no mass.
            const double length = glm::dot(light.gradient, light.gradient) / 3.0;
            weights[f] = {share * light.magnitude,
                          share * share * (light.magnitude * light.magnitude + length)};
        }
        const Energies of =
            channelEnergies(picture, channel, camera, image, weights, engine, shading);
        energy += of.image;
        error += of.error;
        isWhole = isWhole && of.isWhole;
    }
    const double estimate = energy > 0.0 ? std::sqrt(error / energy) : 0.0;
    return isWhole ? std::min(m_bound, estimate) : estimate;
}

} // namespace pellucid::render
