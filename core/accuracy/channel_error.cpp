// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/channel_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "core/accuracy/coarse_plane.h"
#include "core/accuracy/edge_tails.h"
#include "core/accuracy/picture_sums.h"
#include "core/plan/error_prediction.h"
#include "core/plan/folded_tails.h"
#include "core/shading/shading.h"

namespace pellucid::accuracy {

namespace {

// Margins, as energy, for what coarse blocks and mean energies do not model. They were fitted to
// 2,000 random pictures of the bench's suite `pictures` (seeds 604, 911, 1201 to 1204, 1301 to
// 1304, 1401 to 1403, 1501, 1701), which can therefore no longer test them; those of coarse pixels,
// points and tails also to counterexamples and to seeds 9001, 9101, 9301 and 777001.
constexpr double coherentMargin = 2.7, ///< aliases, block by block
    sampleMargin = 1.5,                ///< narrower kernels, of which a sample is known
    detailMargin = 2.4,                ///< aliases of detail finer than the blocks
    coarsePixelMargin = 2.5,           ///< aliases in pixels larger than the blocks
    restMargin = 1.1,                  ///< rounding of cells other than the central ones
    unknownRoundingMargin = 7.1,       ///< rounding where no cell's error is known
    centralMargin = 4.0,               ///< the known rounding of the central cells
    pointMargin = 1.7,                 ///< rounding of a few samples, judged by the central cells
    litPointMargin = 1.5,              ///< the same under light
    meanPointMargin = 2.2,             ///< the same, judged by the mean over cells
    partOfPointsMargin = 3.0,          ///< the same in a part of the picture
    sliceMargin = 1.3,        ///< the energy of the whole slice, of which a sample is known
    edgeMargin = 3.0,         ///< tails of the roll-off, by direction
    patternMargin = 50.0,     ///< tails of patterns in the picture
    outsideMargin = 40.0,     ///< tails of patterns beside the picture
    outsidePointMargin = 5.0; ///< the same of a few samples, whose tails the edge has
// The share of the plan's bound that every picture is charged with, for errors that no term
// describes.
constexpr double unseenShare = 0.08;
// The roughness of a projection relative to its field, fitted to crops beside points and noise.
constexpr double projectedRoughness = 0.4;
// Similar errors add up to point-like aliases. This share of their energy may fall into any part of
// the picture.
constexpr double pointShare = 0.69;
// The energy of rounding over its mean where no cell's error is known.
constexpr double unknownRounding = 1.5;

// The energy of one channel's error, term by term.
class ChannelError {
public:
    ChannelError(const CoarseFields &fields, const PictureContext &context, int channel,
                 std::span<const FieldWeight> weights)
        : m_fields(fields), m_context(context), m_camera(context.camera), m_axes(m_camera.axes()),
          m_pixelMm(m_camera.pixelMm),
          m_windowMm(m_camera.width * m_pixelMm, m_camera.height * m_pixelMm),
          m_periodMm(context.grid.columns * m_pixelMm, context.grid.rows * m_pixelMm),
          m_coarseMm(std::max(fields.blockMm, m_periodMm.x / 128.0)),
          m_sums(pictureSums(context.picture, channel)),
          m_imageEnergy(m_sums.energy * m_pixelMm * m_pixelMm),
          m_centralImage(context.central.image[std::size_t(channel)]),
          m_centralError(context.central.error[std::size_t(channel)]),
          m_centralSlice(context.central.slice[std::size_t(channel)]),
          m_narrowing(context.narrowing[std::size_t(channel)]),
          m_sliceEnergy(context.slice.whole[std::size_t(channel)]),
          m_edge(context.slice.edge[std::size_t(channel)]) {
        weightBlocks(weights);
        projectBlocks();
        // Errors are those of the image without amplified detail. A whole one has no more energy
        // than the shown one; a part may, for example beside a bright edge that it cuts off, but no
        // more than all of the slice.
        m_plainEnergy = context.image.detail > 0.0 && !isWhole() ? wholeEnergy() : m_imageEnergy;
    }

    ChannelEnergies energies(double bound) const {
        ChannelEnergies energies{m_imageEnergy, 0.0, isWhole()};
        if (!(m_imageEnergy > 0.0) || !(m_blocks.all > 0.0))
            return energies;
        const double whole = wholeEnergy();
        const Rounding rounding = roundingErrors(whole);
        energies.error = coherentAliases() + detailMargin * detailAliases() + rounding.few +
                         rounding.others + centralMargin * m_centralError + foldedTails(whole) +
                         momentError(whole) + narrowing() +
                         std::pow(unseenShare * bound, 2) * m_plainEnergy;
        return energies;
    }

private:
    // The energy of the whole projection, of which the picture may show a part.
    double wholeEnergy() const {
        return isWhole() ? m_imageEnergy : std::max(m_imageEnergy, sliceMargin * m_sliceEnergy);
    }

    // The projected energies of blocks and aliases.
    struct BlockSums {
        // Summed block by block.
        double all = 0.0, inPicture = 0.0;
        double beyond = 0.0;                       ///< of blocks with samples beside the picture
        double aliases = 0.0;                      ///< in the picture
        double inverse = 0.0;                      ///< of blocks without the cue, divided by h^2
        double tailsAcross = 0.0, tailsDown = 0.0; ///< of their tails in the picture
        // Energies of the joint projection.
        double projectionInPicture = 0.0;
        double aliasesInPicture = 0.0;
    };
    // The rounding of fields of a few samples, and of others.
    struct Rounding {
        double few = 0.0, others = 0.0;
    };

    // Combines all fields of the channel. Layers may share samples, so their amplitudes add up;
    // gradients and densities are uncorrelated.
    void weightBlocks(std::span<const FieldWeight> weights) {
        const std::size_t count = m_fields.blocks.size();
        m_mass.resize(count);
        m_energy.resize(count);
        std::vector<double> gradient(count);
        for (std::size_t f = 0; f < m_fields.fields.size(); ++f)
            for (const CoarseFields::Part &part : m_fields.fields[f]) {
                m_mass[part.block] += weights[f].mass * double(part.mass);
                (weights[f].isGradient ? gradient : m_energy)[part.block] +=
                    std::sqrt(weights[f].energy * double(part.energy));
            }
        for (std::size_t n = 0; n < count; ++n)
            m_energy[n] = m_energy[n] * m_energy[n] + gradient[n] * gradient[n];
        for (const double e : m_energy)
            m_energyWithoutCue += e;
    }

    void projectBlocks() {
        const shading::DepthCue &cue = m_context.shading.cue;
        const auto value = cue.isActive()
                               ? shading::cueFunction(cue)
                               : std::function<double(double)>([](double) { return 1.0; });
        const glm::dmat3 toCamera = glm::transpose(m_axes);
        const glm::dvec2 pan = m_camera.panMm;
        const double rollOff = m_context.image.rollOff;
        const plan::SliceGrid &grid = m_context.grid;
        // A picture may be smaller than a coarse pixel.
        const glm::dvec2 aliasWindow = m_windowMm + 2.0 * m_coarseMm;
        CoarsePlane plain(m_periodMm, m_coarseMm), aliases(m_periodMm, m_coarseMm);
        for (std::size_t n = 0; n < m_energy.size(); ++n) {
            if (m_energy[n] == 0.0)
                continue;
            const CoarseFields::Block &block = m_fields.blocks[n];
            // Returns the energy in the picture.
            const auto add = [&](CoarsePlane &plane, const glm::dvec3 &at, double amplitude,
                                 const glm::dvec2 &window) {
                const glm::dvec3 seen = toCamera * at;
                const double weight = amplitude * value(seen.z / m_fields.depthRadiusMm);
                plane.add(seen.x - pan.x, seen.y - pan.y, weight * m_mass[n]);
                const bool isInside =
                    CoarsePlane::isWithin(seen.x - pan.x, m_periodMm.x, window.x) &&
                    CoarsePlane::isWithin(seen.y - pan.y, m_periodMm.y, window.y);
                return isInside ? weight * weight * m_energy[n] : 0.0;
            };
            m_blocks.inPicture += add(plain, block.fromCentreMm, 1.0, m_windowMm);
            const glm::dvec3 seen = toCamera * block.fromCentreMm;
            const double weight = value(seen.z / m_fields.depthRadiusMm),
                         here = weight * weight * m_energy[n];
            m_blocks.all += here;
            m_places.add({seen.x - pan.x, seen.y - pan.y}, m_periodMm, here);
            m_blocks.tailsAcross += here * plan::tailInImage(rollOff, grid.columns, m_camera.width,
                                                             (seen.x - pan.x) / m_pixelMm);
            m_blocks.tailsDown += here * plan::tailInImage(rollOff, grid.rows, m_camera.height,
                                                           (seen.y - pan.y) / m_pixelMm);
            m_blocks.inverse += double(block.inverse) * m_energy[n];
            if (reachesBeyond(block, {seen.x - pan.x, seen.y - pan.y}))
                m_blocks.beyond += here;
            forAliases(block, [&](const glm::dvec3 &offset, double amplitude) {
                m_blocks.aliases +=
                    add(aliases, block.fromCentreMm + offset, amplitude, aliasWindow);
            });
        }
        m_blocks.projectionInPicture = plain.energyIn({0.0, 0.0}, m_windowMm);
        m_blocks.aliasesInPicture = aliases.energyIn({0.0, 0.0}, aliasWindow);
    }

    // The aliases of a block: along one axis, or the products of two or three. `use`: gets the
    // offset and the amplitude.
    template <class F> void forAliases(const CoarseFields::Block &block, const F &use) const {
        constexpr double negligible = 1e-7;
        const auto along = [&](std::size_t d, int m) {
            return m == 0 ? 1.0 : double(block.aliases[2 * d + (m > 0 ? 1 : 0)]);
        };
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const double amplitude = along(0, i) * along(1, j) * along(2, k);
                    if ((i != 0 || j != 0 || k != 0) && std::abs(amplitude) > negligible)
                        use(double(i) * m_fields.periodsMm[0] + double(j) * m_fields.periodsMm[1] +
                                double(k) * m_fields.periodsMm[2],
                            amplitude);
                }
    }

    // Whether the picture misses some sample of a block; `seen`: its middle.
    bool reachesBeyond(const CoarseFields::Block &block, const glm::dvec2 &seen) const {
        for (int axis = 0; axis < 2; ++axis) {
            double half = 0.0;
            for (std::size_t d = 0; d < 3; ++d)
                half += double(block.halfSteps[d]) *
                        std::abs(glm::dot(m_fields.lattice.step(int(d)), m_axes[axis]));
            if (std::abs(seen[axis]) + half > 0.5 * m_windowMm[axis])
                return true;
        }
        return false;
    }

    bool isWhole() const { return m_blocks.beyond <= 1e-9 * m_blocks.all; }

    // Coarse pixels larger than the blocks spread each block over several pixels.
    double coherentAliases() const {
        const double coarseMargin = m_coarseMm > 2.0 * m_fields.blockMm ? coarsePixelMargin : 1.0;
        return coarseMargin * coherentMargin * m_blocks.aliasesInPicture;
    }

    // Detail finer than the blocks (edges and noise) has aliases in proportion to its energy.
    // Beside the picture, samples are taken as uncorrelated. Blocks at its edge count as beside it.
    double detailAliases() const {
        const double cellMm3 = m_fields.lattice.cellVolumeMm3(),
                     lengthMm =
                         cellMm3 / std::max(std::pow(cellMm3, 2.0 / 3.0), m_pixelMm * m_pixelMm),
                     outside = std::max(m_blocks.beyond, m_blocks.all - m_blocks.inPicture),
                     unseen = std::max(0.05 * m_plainEnergy,
                                       m_plainEnergy - m_blocks.projectionInPicture);
        return m_blocks.aliases * (unseen + outside * lengthMm) / m_blocks.all;
    }

    // 1 for fields of a few samples, near 0 for fields with widely spread energy.
    double sparsity() const {
        double concentration = 0.0;
        for (const auto &spread : m_fields.spreads)
            concentration = std::max(concentration, spread->concentration);
        return std::min(1.0, 2.5 * concentration);
    }

    // The share of the energy of rounding that is in the picture.
    double roundingInPicture() const {
        const auto &shares = m_fields.roundingShares;
        std::array<std::array<glm::dvec2, 2>, 3> axes; // half a step, and the period
        glm::dvec2 half(0.0);
        for (std::size_t d = 0; d < 3; ++d) {
            const glm::dvec2 period(glm::dot(m_fields.periodsMm[d], m_axes[0]),
                                    glm::dot(m_fields.periodsMm[d], m_axes[1]));
            axes[d] = {period / double(shares[d].size()), period};
            half += glm::abs(axes[d][0]);
        }
        const auto at = [&](std::size_t d, std::size_t n) {
            return (2.0 * double(n) + 1.0) * axes[d][0] - axes[d][1];
        };
        // The part of a step around a point that is in the window.
        const auto within = [&](const glm::dvec2 &point) {
            double part = 1.0;
            for (int axis = 0; axis < 2; ++axis) {
                const double period = m_periodMm[axis], window = m_windowMm[axis],
                             off = point[axis] - m_camera.panMm[axis],
                             away = std::abs(off - period * std::round(off / period)),
                             width = std::max(2.0 * half[axis], 1e-9 * window);
                part *= std::clamp((0.5 * (width + window) - away) / width, 0.0,
                                   std::min(1.0, window / width));
            }
            return part;
        };
        double sum = 0.0;
        for (std::size_t k = 0; k < shares[2].size(); ++k)
            for (std::size_t j = 0; j < shares[1].size(); ++j)
                for (std::size_t i = 0; i < shares[0].size(); ++i)
                    sum += shares[0][i] * shares[1][j] * shares[2][k] *
                           within(at(0, i) + at(1, j) + at(2, k));
        return sum;
    }

    // The rounding of all cells except the central ones, over the whole period. The cue weights it
    // by the depths of the whole period, and the image by the depths of the field. Where the field
    // is dark, a few bright cells beside it dominate.
    double otherRounding(double whole) const {
        const shading::DepthCue &cue = m_context.shading.cue;
        const double cueRms = plan::cueRms(cue),
                     dimmed = cueRms * cueRms * m_energyWithoutCue / m_blocks.all;
        return m_fields.rounding * m_fields.rounding * m_fields.kernelEnergy * m_blocks.inverse /
               m_energyWithoutCue *
               (cue.isActive() ? std::max(1.0, dimmed * std::min(2.0, dimmed)) : 1.0) *
               std::max(0.05 * whole, whole - m_centralSlice);
    }

    // All cells of the spectrum of a few samples are alike and round alike, so the central cells
    // represent all of them: by their error in this view in a whole picture, and by their rounding
    // in a part, which may contain none of them. Under light a sample's gradient covers several
    // samples, which are less alike. If the share of the central cells is unknown, a few
    // frequencies of each field dominate, and average out less.
    Rounding roundingErrors(double whole) const {
        const bool isLit = m_context.shading.isLit();
        const bool isKnown = m_centralImage > 0.0, representAll = isKnown && isWhole();
        const double few = sparsity(), part = roundingInPicture(), rest = otherRounding(whole);
        const double alike = isLit ? 0.0 : few,
                     known = isKnown ? m_context.central.cellRounding /
                                           (m_fields.rounding * m_fields.rounding)
                                     : unknownRounding,
                     pointRounding = representAll ? few * m_centralError / m_centralImage *
                                                        std::max(0.0, whole - m_centralImage)
                                                  : 0.0,
                     partRounding = alike * std::max(pointShare, part) * known * rest;
        // The view may pass through the few of them that round best: then their mean counts.
        return {representAll ? std::max((isLit ? litPointMargin : pointMargin) * pointRounding,
                                        meanPointMargin * alike * part * known * rest)
                             : partOfPointsMargin * partRounding,
                (isKnown ? restMargin : unknownRoundingMargin) * part * rest *
                    (representAll ? 1.0 - alike : 1.0)};
    }

    // Tails of the roll-off that come back into the picture after a period. The sampled edge of the
    // band may miss the lines of a pattern. In the picture they are seen; beside it, the field's
    // own roughness tells, reduced because projections are smoother than samples, and limited to
    // that of white samples in pixels of this size.
    double foldedTails(double whole) const {
        double roughness = 0.0;
        for (const auto &spread : m_fields.spreads)
            roughness = std::max(roughness, spread->roughness);
        const double stepMm = m_fields.lattice.shortestStepMm(),
                     white = std::min(1.0, 0.2 * std::pow(std::max(1.0, m_pixelMm / stepMm), 2.0)),
                     margin = std::lerp(outsideMargin, outsidePointMargin, sparsity()),
                     outside = margin * std::min(projectedRoughness * roughness, white) *
                               (m_context.image.detail > 0.0 ? whole : whole - m_imageEnergy);
        const double pattern =
            ((patternMargin * m_sums.across * m_plainEnergy + outside) * m_blocks.tailsAcross +
             (patternMargin * m_sums.down * m_plainEnergy + outside) * m_blocks.tailsDown) /
            m_blocks.all;
        const double edge = edgeTails(m_places, {m_windowMm, m_periodMm, m_pixelMm},
                                      m_context.image.rollOff, m_edge);
        return std::max({edgeMargin * edge, pattern, tailsOfLattice(whole)});
    }

    // Tails of the lattice's own band cannot be derived from the edge of the picture's band, which
    // may be finer.
    double tailsOfLattice(double whole) const {
        if (m_context.image.reconstruction != scene::Reconstruction::bandLimited)
            return 0.0;
        const plan::SliceGrid &grid = m_context.grid;
        double worst = 0.0;
        for (const auto &spread : m_fields.spreads)
            worst = std::max(
                worst, whole * plan::shareInImage(m_camera, *spread) *
                           std::pow(plan::predictFoldedTails(m_context.image, m_camera,
                                                             grid.columns, grid.rows, *spread),
                                    2));
        return worst;
    }

    // The picture may show a small part with all of the detail that narrower kernels blur.
    double narrowing() const { return sampleMargin * m_narrowing; }

    // A linear cue has its own kernels for depth, and these have their own error: the energy
    // without the cue, times the depth of a period.
    double momentError(double whole) const {
        const shading::DepthCue &cue = m_context.shading.cue;
        double sum = 0.0;
        if (cue.kind == shading::CueKind::linear)
            for (std::size_t d = 0; d < 3; ++d)
                sum += std::pow(cue.strength * glm::dot(m_fields.periodsMm[d], m_axes[2]) /
                                    m_fields.depthRadiusMm,
                                2) *
                       m_fields.moments[d] * whole * m_energyWithoutCue / m_blocks.all;
        return sum;
    }

    const CoarseFields &m_fields;
    const PictureContext &m_context;
    const scene::Camera &m_camera;
    glm::dmat3 m_axes;
    double m_pixelMm;
    glm::dvec2 m_windowMm, m_periodMm; ///< of the picture; of the slice grid
    double m_coarseMm;                 ///< pixel size of coarse planes
    PictureSums m_sums;
    double m_imageEnergy, m_centralImage, m_centralError, m_centralSlice, m_narrowing;
    double m_plainEnergy = 0.0; ///< at most, of the image without amplified detail
    double m_sliceEnergy;       ///< over the whole period
    const std::array<double, SliceEnergies::directions> &m_edge; ///< see SliceEnergies
    ProjectedPlaces m_places;
    std::vector<double> m_mass, m_energy; ///< of blocks, without the cue
    double m_energyWithoutCue = 0.0;
    BlockSums m_blocks;
};

} // namespace

ChannelEnergies channelEnergies(const CoarseFields &fields, double bound,
                                const PictureContext &context, int channel,
                                std::span<const FieldWeight> weights) {
    return ChannelError(fields, context, channel, weights).energies(bound);
}

} // namespace pellucid::accuracy
