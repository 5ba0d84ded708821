// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/view_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/plan/error_prediction.h"
#include "core/plan/folded_tails.h"
#include "core/shading/slice_shading.h"

namespace pellucid::accuracy {

namespace {

// Margins, as energy, for what coarse blocks and mean energies leave out. They were fitted to 2,000
// random pictures of the bench's suite `pictures` (seeds 604, 911, 1201 to 1204, 1301 to 1304, 1401
// to 1403, 1501, 1701), which can therefore no longer test them; those of coarse pixels and points
// also to counterexamples.
constexpr double coherentMargin = 2.7, ///< ghosts, block by block
    detailMargin = 2.4,                ///< ghosts of what blocks do not show
    coarsePixelMargin = 2.5,           ///< ghosts in pixels larger than the blocks
    restMargin = 1.1,                  ///< rounding of other cells than the central ones
    aloneMargin = 7.1,                 ///< rounding where no cell's is known
    centralMargin = 4.0,               ///< the known rounding of the central cells
    pointMargin = 1.7,                 ///< rounding of a few samples, judged by the central cells
    litPointMargin = 1.5,              ///< the same under light
    partOfPointsMargin = 3.0,          ///< the same in a part of the picture
    tailMargin = 50.0,                 ///< tails of the picture
    patternBesideMargin = 40.0,        ///< tails of what lies beside it
    pointBesideMargin = 15.0;          ///< the same of a few samples
// The part of the plan's bound that every picture is charged with, for what no term describes.
constexpr double unseenShare = 0.094;
// Similar errors add up to point-like ghosts; this share of their energy may fall in any part of
// the picture.
constexpr double pointShare = 0.69;
// The energy of rounding over its mean where no cell's is known.
constexpr double unknownRounding = 1.5;
// How rough a projection is, relative to its field; chosen on crops beside points and noise.
constexpr double projectedRoughness = 0.4;
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
            return std::min(count - 1, int(n - count * std::floor(n / count)));
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

// The energy of a picture, and the share of it that the filter at the edge of the band passes
// along each axis, over what it passes of white noise.
struct PictureSums {
    double energy = 0.0, across = 0.0, down = 0.0;
};

// A filter that passes only what lies within 0.06 cycles per pixel of the highest frequency, where
// the tails of the roll-off come from: cos^4 about half the sampling rate. Of frequency 0 it passes
// 1e-12, as energy.
class EdgeFilter {
public:
    EdgeFilter() {
        double squares = 0.0;
        for (int n = -reach; n <= reach; ++n) {
            const double cosine = std::cos(0.5 * std::numbers::pi * n / (reach + 1));
            const double factor = (n % 2 == 0 ? 1.0 : -1.0) * std::pow(cosine, 4);
            m_factors[std::size_t(n + reach)] = factor;
            squares += factor * factor;
        }
        for (double &factor : m_factors)
            factor /= std::sqrt(squares);
    }

    // The energies of a line and of what passes. The line's ends are extended as constants.
    template <class Value> std::array<double, 2> energies(int length, const Value &value) {
        m_line.resize(std::size_t(length + 2 * reach));
        m_passed.assign(std::size_t(length), 0.0);
        for (int n = -reach; n < length + reach; ++n)
            m_line[std::size_t(n + reach)] = value(std::clamp(n, 0, length - 1));
        for (std::size_t tap = 0; tap < m_factors.size(); ++tap)
            for (std::size_t n = 0; n < m_passed.size(); ++n)
                m_passed[n] += m_factors[tap] * m_line[n + tap];
        std::array<double, 2> sums{};
        for (std::size_t n = 0; n < m_passed.size(); ++n) {
            sums[0] += m_line[n + reach] * m_line[n + reach];
            sums[1] += m_passed[n] * m_passed[n];
        }
        return sums;
    }

private:
    static constexpr int reach = 24;
    std::array<double, 2 * reach + 1> m_factors{};
    std::vector<double> m_line, m_passed;
};

PictureSums sumsOf(const picture::ProjectionImage &picture, int channel) {
    const auto value = [&](int row, int column) {
        return double(picture.samples[(std::size_t(row) * picture.width + column) *
                                          std::size_t(picture.channels) +
                                      std::size_t(channel)]);
    };
    EdgeFilter filter;
    // A subset of the lines of a large picture is enough.
    constexpr int enough = 128;
    const auto along = [&](int lines, int length, const auto &sample) {
        std::array<double, 2> sums{};
        const int step = std::max(1, lines / enough);
        for (int line = 0; line < lines; line += step) {
            const auto of = filter.energies(length, [&](int n) { return sample(line, n); });
            sums[0] += step * of[0];
            sums[1] += step * of[1];
        }
        return sums;
    };
    const auto rows =
        along(picture.height, picture.width, [&](int line, int n) { return value(line, n); });
    const auto columns =
        along(picture.width, picture.height, [&](int line, int n) { return value(n, line); });
    const auto share = [](const std::array<double, 2> &sums) {
        return sums[0] > 0.0 ? std::min(1.0, sums[1] / sums[0]) : 0.0;
    };
    double energy = 0.0;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column)
            energy += value(row, column) * value(row, column);
    return {energy, share(rows), share(columns)};
}

} // namespace

ViewErrorModel::ViewErrorModel(const plan::RenderPlan &plan,
                               std::span<const plan::FieldSummary> fields)
    : m_lattice(fields.front().lattice), m_room(plan.room), m_bound(plan.predictedError) {
    const fourier::SpectrumLayout &layout = plan.spectrum;
    const std::array<int, 3> padded{layout.padded.i, layout.padded.j, layout.padded.k};
    const std::array<int, 3> first{layout.box.lo.i, layout.box.lo.j, layout.box.lo.k};
    const volume::GridSize size = layout.box.size();
    std::array<std::vector<plan::BlockRange>, 3> ranges;
    struct AxisBlock {
        double middle, before, after, inverse;
    };
    std::array<std::vector<AxisBlock>, 3> axes;
    for (int d = 0; d < 3; ++d) {
        const auto axis = std::size_t(d);
        const fourier::Kernel &kernel = layout.kernels[axis];
        ranges[axis] = plan::blockRanges(size[d]);
        m_periods[axis] = double(padded[axis]) * m_lattice.step(d);
        m_kernelEnergy *= size[d] <= fewSamples ? 1.0 : kernel.energy();
        for (const plan::BlockRange &range : ranges[axis]) {
            // Root mean squares over the block, as the energy lies in it; the sign of its middle.
            double before = 0.0, after = 0.0, inverse = 0.0, all = 0.0;
            for (int n = range.first; n <= range.last; ++n) {
                double weight = 1e-12; // for blocks without energy
                for (const plan::FieldSummary &field : fields)
                    weight += field.energy.axis[axis][std::size_t(n)];
                const double x = double(n - size[d] / 2) / padded[axis]; // NOLINT: whole
                const double h = kernel.apodisation(x);
                for (const int m : {-2, -1})
                    before += weight * std::pow(kernel.apodisation(x + m) / h, 2);
                for (const int m : {1, 2})
                    after += weight * std::pow(kernel.apodisation(x + m) / h, 2);
                inverse += weight / (h * h);
                all += weight;
            }
            before /= all;
            after /= all;
            inverse /= all;
            const double middle = 0.5 * (range.first + range.last),
                         x = (middle - size[d] / 2) / padded[axis]; // NOLINT: whole
            axes[axis].push_back({middle + first[axis],
                                  std::copysign(std::sqrt(before), kernel.apodisation(x - 1.0)),
                                  std::copysign(std::sqrt(after), kernel.apodisation(x + 1.0)),
                                  size[d] <= fewSamples ? 1.0 : inverse});
        }
        const fourier::MomentKernel moment(kernel, double(padded[axis]) / size[d]);
        for (const plan::FieldSummary &field : fields) {
            plan::AxisError left;
            plan::addMomentError(left, kernel, moment, padded[axis],
                                 field.slabs ? (*field.slabs)[axis]
                                             : plan::evenSlabProducts(field.energy.axis[axis]));
            m_moments[axis] = std::max(m_moments[axis], left.moment);
        }
        m_blockMm = std::max(m_blockMm, double(size[d]) / double(ranges[axis].size()) *
                                            m_lattice.spacingMm(d));
    }
    std::map<std::array<std::uint8_t, 3>, std::uint32_t> known;
    const glm::dvec3 centre = m_lattice.center().mm;
    for (const plan::FieldSummary &field : fields) {
        std::vector<Part> &parts = m_fields.emplace_back();
        for (const plan::FieldBlock &block : field.energy.blocks) {
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

ViewErrorModel::Energies ViewErrorModel::channelEnergies(const picture::ProjectionImage &picture,
                                                         int channel, const scene::Camera &camera,
                                                         const scene::ImageDefinition &image,
                                                         const plan::SliceGrid &grid,
                                                         std::span<const Weight> weights,
                                                         const CentralEnergies &central,
                                                         const shading::Shading &shading) const {
    const shading::DepthCue &cue = shading.cue;
    const glm::dmat3 axes = camera.axes();
    const double pixel = camera.pixelMm;
    const PictureSums sums = sumsOf(picture, channel);
    Energies energies{sums.energy * pixel * pixel, 0.0};
    // All fields of the channel as one. Layers may share samples, so their amplitudes add up; those
    // of gradients have nothing to do with those of densities.
    std::vector<double> mass(m_blocks.size()), energy(m_blocks.size()), gradient(m_blocks.size());
    for (std::size_t f = 0; f < m_fields.size(); ++f)
        for (const Part &part : m_fields[f]) {
            mass[part.block] += weights[f].mass * double(part.mass);
            (weights[f].isGradient ? gradient : energy)[part.block] +=
                std::sqrt(weights[f].energy * double(part.energy));
        }
    for (std::size_t n = 0; n < m_blocks.size(); ++n)
        energy[n] = energy[n] * energy[n] + gradient[n] * gradient[n];
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
        tailsAcross += here * plan::tailInImage(image.rollOff, grid.columns, camera.width,
                                                (seen.x - camera.panMm.x) / pixel);
        tailsDown += here * plan::tailInImage(image.rollOff, grid.rows, camera.height,
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
    energies.isWhole = sum - all <= 1e-9 * sum;
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
    // Rounding is all over the period, the picture a part of it. Without the central cells' share
    // some frequencies of each field decide, which average less.
    double concentration = 0.0;
    for (const auto &spread : m_spreads)
        concentration = std::max(concentration, spread->concentration);
    double periodMm2 = 0.0; // as seen
    for (std::size_t d = 0; d < 3; ++d)
        periodMm2 += std::abs(glm::dot(glm::cross(m_periods[d], m_periods[(d + 1) % 3]), axes[2]));
    const double part = std::min(1.0, 1.6 * window.x * window.y / periodMm2),
                 centralImage = central.image[std::size_t(channel)],
                 centralError = central.error[std::size_t(channel)],
                 whole = energies.image + beside;
    // The cue weighs rounding by depths all over the period, the image by the depths of the field.
    const double cueRms = plan::cueRms(cue), dimmed = cueRms * cueRms * total / sum;
    const double rest = m_rounding * m_rounding * m_kernelEnergy * inverse / total *
                        (cue.isActive() ? std::max(1.0, dimmed) : 1.0) *
                        std::max(0.05 * whole, whole - centralImage);
    // Tails come from what the picture has at the edge of its band, along each of its axes.
    // The picture does not show how rough the field is beside it. The field's own roughness stands
    // in for it, reduced because projections are smoother than samples, and limited to that of
    // white samples in pixels of this size.
    double roughness = 0.0;
    for (const auto &spread : m_spreads)
        roughness = std::max(roughness, spread->roughness);
    const double white =
        std::min(1.0, 0.2 * std::pow(std::max(1.0, pixel / m_lattice.shortestStepMm()), 2.0));
    const double fewness = std::min(1.0, 2.5 * concentration),
                 besideMargin = std::lerp(patternBesideMargin, pointBesideMargin, fewness);
    const auto tails = [&](double rough) {
        return tailMargin * rough * energies.image +
               besideMargin * std::min(std::max(rough, projectedRoughness * roughness), white) *
                   beside;
    };
    double folded = (tails(sums.across) * tailsAcross + tails(sums.down) * tailsDown) / sum;
    // Tails of the lattice's own band cannot be told by what the picture has at the edge of its
    // own, which may be finer.
    if (image.reconstruction == scene::Reconstruction::bandLimited)
        for (const auto &spread : m_spreads)
            folded =
                std::max(folded, whole * plan::shareInImage(camera, *spread) *
                                     std::pow(plan::predictFoldedTails(image, camera, grid.columns,
                                                                       grid.rows, *spread),
                                              2));
    // All cells of a few samples' spectrum are alike and round alike, so the central ones represent
    // all: in a whole picture by the error that they make in this view, in a part, which may hold
    // none of them, by their rounding. Under light a sample's gradient is several samples, which
    // are less alike.
    const bool isKnown = centralImage > 0.0, representAll = isKnown && energies.isWhole;
    const double alike = shading.isLit() ? 0.0 : fewness,
                 known = isKnown ? central.ofCells / (m_rounding * m_rounding) : unknownRounding,
                 ofPoints = representAll ? fewness * centralError / centralImage *
                                               std::max(0.0, whole - centralImage)
                                         : 0.0,
                 ofPart = alike * std::max(pointShare, part) * known * rest;
    const double few = (shading.isLit() ? litPointMargin : pointMargin) * ofPoints +
                       (representAll ? 0.0 : partOfPointsMargin * ofPart);
    const double others =
        (isKnown ? restMargin : aloneMargin) * part * rest * (representAll ? 1.0 - alike : 1.0);
    // A linear cue reads depth by kernels of its own, which leave an error of their own: of a
    // picture without the cue, by how much depth a period is.
    double moments = 0.0;
    if (cue.kind == shading::CueKind::linear)
        for (std::size_t d = 0; d < 3; ++d)
            moments +=
                std::pow(cue.strength * glm::dot(m_periods[d], axes[2]) / m_depthRadiusMm, 2) *
                m_moments[d] * whole * total / sum;
    // Coarse pixels that are larger than the blocks spread each of them over several.
    const double ofCoarse = coarseMm > 2.0 * m_blockMm ? coarsePixelMargin : 1.0;
    energies.error = ofCoarse * coherentMargin * coherent + detailMargin * detail + few + others +
                     centralMargin * centralError + folded + moments +
                     std::pow(unseenShare * m_bound, 2) * energies.image;
    return energies;
}

PictureError ViewErrorModel::errorOf(const picture::ProjectionImage &picture,
                                     const scene::Camera &camera,
                                     const scene::ImageDefinition &image,
                                     const render::EngineParts &engine,
                                     const shading::Shading &shading) const {
    if (picture.samples.empty())
        return {m_bound, true};
    const std::vector<render::ChannelShares> &shares = engine.shares;
    // Without light the weights are the same; R and the step do not matter to them.
    const shading::SliceShading slices = shading::sliceShading(shading, camera.axes(), {});
    const bool isLit = shading.isLit();
    const plan::SliceGrid grid = plan::sliceGrid(camera, m_room, m_lattice, image);
    const CentralEnergies central = centralEnergies(engine, camera, grid, shading);
    double energy = 0.0, error = 0.0;
    bool isWhole = true, areSingle = true; // what the plan's bound is for
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
                weights[f] = {weight, weight * weight, isGradient};
                continue;
            }
            // Directed light sees a third of the gradient's energy, and no mass.
            const double length = glm::dot(light.gradient, light.gradient) / 3.0;
            weights[f] = {share * light.magnitude,
                          share * share * (light.magnitude * light.magnitude + length), isGradient};
        }
        const Energies of =
            channelEnergies(picture, channel, camera, image, grid, weights, central, shading);
        energy += of.image;
        error += of.error;
        const auto isShown = [&](const render::ChannelShares &share) { return share[c] != 0.0; };
        isWhole = isWhole && of.isWhole;
        areSingle = areSingle && std::count_if(shares.begin(), shares.end(), isShown) <= 1;
    }
    // Relative to what is shown, which is the exact picture and the error; where the error may be
    // all of it, little is known of the exact one.
    constexpr double leastLeft = 1e-3;
    const double ofShown = energy > 0.0 ? std::sqrt(error / energy) : 0.0,
                 estimate = ofShown / std::max(leastLeft, 1.0 - ofShown);
    return {isWhole && areSingle ? std::min(m_bound, estimate) : estimate, isWhole};
}

} // namespace pellucid::accuracy
