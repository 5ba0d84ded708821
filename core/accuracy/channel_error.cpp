// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/accuracy/channel_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "core/accuracy/coarse_plane.h"
#include "core/accuracy/picture_sums.h"
#include "core/plan/error_prediction.h"
#include "core/plan/folded_tails.h"
#include "core/shading/shading.h"

namespace pellucid::accuracy {

namespace {

// Margins, as energy, for what coarse blocks and mean energies leave out. They were fitted to 2,000
// random pictures of the bench's suite `pictures` (seeds 604, 911, 1201 to 1204, 1301 to 1304, 1401
// to 1403, 1501, 1701), which can therefore no longer test them; those of coarse pixels and points
// also to counterexamples.
constexpr double coherentMargin = 2.7, ///< aliases, block by block
    detailMargin = 2.4,                ///< aliases of what blocks do not show
    coarsePixelMargin = 2.5,           ///< aliases in pixels larger than the blocks
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
// Similar errors add up to point-like aliases; this share of their energy may fall in any part of
// the picture.
constexpr double pointShare = 0.69;
// The energy of rounding over its mean where no cell's is known.
constexpr double unknownRounding = 1.5;
// How rough a projection is, relative to its field; chosen on crops beside points and noise.
constexpr double projectedRoughness = 0.4;

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
          m_centralError(context.central.error[std::size_t(channel)]) {
        weighBlocks(weights);
        projectBlocks();
    }

    ChannelEnergies energies(double bound) const {
        ChannelEnergies energies{m_imageEnergy, 0.0, isWhole()};
        if (!(m_imageEnergy > 0.0) || !(m_blocks.all > 0.0))
            return energies;
        const Beside beside = besidePicture();
        const double whole = m_imageEnergy + beside.energy;
        const Rounding rounding = roundingErrors(whole);
        energies.error = coherentAliases() + detailMargin * detailAliases(beside) + rounding.few +
                         rounding.others + centralMargin * m_centralError +
                         foldedTails(beside, whole) + momentError(whole) +
                         std::pow(unseenShare * bound, 2) * m_imageEnergy;
        return energies;
    }

private:
    // The energies of blocks and aliases as they are seen.
    struct BlockSums {
        // Each block or alias by itself.
        double all = 0.0, inPicture = 0.0;
        double aliases = 0.0;                      ///< in the picture
        double inverse = 0.0;                      ///< of blocks without the cue, times 1/h^2
        double tailsAcross = 0.0, tailsDown = 0.0; ///< what their tails leave in the picture
        // Their projections.
        double projection = 0.0, projectionInPicture = 0.0;
        double aliasesInPicture = 0.0;
    };
    // What lies beside the picture.
    struct Beside {
        double blocks = 0.0;   ///< energy of blocks, each by itself
        double energy = 0.0;   ///< of a projection of them
        double lengthMm = 1.0; ///< over which a sample's energy is projected
    };
    // The rounding of fields of a few samples, and of others.
    struct Rounding {
        double few = 0.0, others = 0.0;
    };

    // All fields of the channel as one. Layers may share samples, so their amplitudes add up; those
    // of gradients have nothing to do with those of densities.
    void weighBlocks(std::span<const FieldWeight> weights) {
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
        CoarsePlane plain(m_periodMm, m_coarseMm), aliases(m_periodMm, m_coarseMm);
        for (std::size_t n = 0; n < m_energy.size(); ++n) {
            if (m_energy[n] == 0.0)
                continue;
            const CoarseFields::Block &block = m_fields.blocks[n];
            // Returns the energy that lies in the picture.
            const auto add = [&](CoarsePlane &plane, const glm::dvec3 &at, double amplitude) {
                const glm::dvec3 seen = toCamera * at;
                const double weight = amplitude * value(seen.z / m_fields.depthRadiusMm);
                plane.add(seen.x - pan.x, seen.y - pan.y, weight * m_mass[n]);
                const bool isInside =
                    CoarsePlane::isWithin(seen.x - pan.x, m_periodMm.x, m_windowMm.x) &&
                    CoarsePlane::isWithin(seen.y - pan.y, m_periodMm.y, m_windowMm.y);
                return isInside ? weight * weight * m_energy[n] : 0.0;
            };
            m_blocks.inPicture += add(plain, block.fromCentreMm, 1.0);
            const glm::dvec3 seen = toCamera * block.fromCentreMm;
            const double weight = value(seen.z / m_fields.depthRadiusMm),
                         here = weight * weight * m_energy[n];
            m_blocks.all += here;
            m_blocks.tailsAcross += here * plan::tailInImage(rollOff, grid.columns, m_camera.width,
                                                             (seen.x - pan.x) / m_pixelMm);
            m_blocks.tailsDown += here * plan::tailInImage(rollOff, grid.rows, m_camera.height,
                                                           (seen.y - pan.y) / m_pixelMm);
            m_blocks.inverse += double(block.inverse) * m_energy[n];
            for (std::size_t d = 0; d < 3; ++d) {
                const glm::dvec3 &period = m_fields.periodsMm[d];
                m_blocks.aliases +=
                    add(aliases, block.fromCentreMm - period, double(block.aliases[2 * d]));
                m_blocks.aliases +=
                    add(aliases, block.fromCentreMm + period, double(block.aliases[2 * d + 1]));
            }
        }
        m_blocks.projection = plain.energyIn({0.0, 0.0}, m_periodMm);
        m_blocks.projectionInPicture = plain.energyIn({0.0, 0.0}, m_windowMm);
        m_blocks.aliasesInPicture = aliases.energyIn({0.0, 0.0}, m_windowMm);
    }

    bool isWhole() const { return m_blocks.all - m_blocks.inPicture <= 1e-9 * m_blocks.all; }

    // A part of the picture suffers from what lies beside it as well: from the mass of its blocks,
    // and from samples that have nothing to do with each other.
    Beside besidePicture() const {
        const double cellMm3 = m_fields.lattice.cellVolumeMm3();
        Beside beside;
        beside.blocks = std::max(0.0, m_blocks.all - m_blocks.inPicture);
        beside.lengthMm = cellMm3 / std::max(std::pow(cellMm3, 2.0 / 3.0), m_pixelMm * m_pixelMm);
        beside.energy = std::max(0.0, m_blocks.projection - m_blocks.projectionInPicture) +
                        beside.blocks * beside.lengthMm;
        return beside;
    }

    // Coarse pixels that are larger than the blocks spread each of them over several.
    double coherentAliases() const {
        const double ofCoarse = m_coarseMm > 2.0 * m_fields.blockMm ? coarsePixelMargin : 1.0;
        return ofCoarse * coherentMargin * m_blocks.aliasesInPicture;
    }

    // What blocks do not show, edges and noise, has aliases as its energy lies.
    double detailAliases(const Beside &beside) const {
        const double unseen =
            std::max(0.05 * m_imageEnergy, m_imageEnergy - m_blocks.projectionInPicture);
        return m_blocks.aliases * (unseen + beside.blocks * beside.lengthMm) / m_blocks.all;
    }

    // 1 for fields of a few samples, near 0 for those whose energy is spread out.
    double fewness() const {
        double concentration = 0.0;
        for (const auto &spread : m_fields.spreads)
            concentration = std::max(concentration, spread->concentration);
        return std::min(1.0, 2.5 * concentration);
    }

    // Rounding is all over the period, the picture a part of it.
    double partOfPeriod() const {
        double periodMm2 = 0.0; // as seen
        for (std::size_t d = 0; d < 3; ++d)
            periodMm2 += std::abs(glm::dot(
                glm::cross(m_fields.periodsMm[d], m_fields.periodsMm[(d + 1) % 3]), m_axes[2]));
        return std::min(1.0, 1.6 * m_windowMm.x * m_windowMm.y / periodMm2);
    }

    // The rounding of all cells but the central ones, all over the period. The cue weighs it by
    // depths all over the period, and the image by the depths of the field.
    double restOfRounding(double whole) const {
        const shading::DepthCue &cue = m_context.shading.cue;
        const double cueRms = plan::cueRms(cue),
                     dimmed = cueRms * cueRms * m_energyWithoutCue / m_blocks.all;
        return m_fields.rounding * m_fields.rounding * m_fields.kernelEnergy * m_blocks.inverse /
               m_energyWithoutCue * (cue.isActive() ? std::max(1.0, dimmed) : 1.0) *
               std::max(0.05 * whole, whole - m_centralImage);
    }

    // All cells of a few samples' spectrum are alike and round alike, so the central ones represent
    // all: in a whole picture by the error that they make in this view, in a part, which may hold
    // none of them, by their rounding. Under light a sample's gradient is several samples, which
    // are less alike. Without the central cells' share some frequencies of each field decide, which
    // average less.
    Rounding roundingErrors(double whole) const {
        const bool isLit = m_context.shading.isLit();
        const bool isKnown = m_centralImage > 0.0, representAll = isKnown && isWhole();
        const double few = fewness(), part = partOfPeriod(), rest = restOfRounding(whole);
        const double alike = isLit ? 0.0 : few,
                     known = isKnown ? m_context.central.ofCells /
                                           (m_fields.rounding * m_fields.rounding)
                                     : unknownRounding,
                     ofPoints = representAll ? few * m_centralError / m_centralImage *
                                                   std::max(0.0, whole - m_centralImage)
                                             : 0.0,
                     ofPart = alike * std::max(pointShare, part) * known * rest;
        return {(isLit ? litPointMargin : pointMargin) * ofPoints +
                    (representAll ? 0.0 : partOfPointsMargin * ofPart),
                (isKnown ? restMargin : aloneMargin) * part * rest *
                    (representAll ? 1.0 - alike : 1.0)};
    }

    // Tails come from what the picture has at the edge of its band, along each of its axes. The
    // picture does not show how rough the field is beside it. The field's own roughness stands in
    // for it, reduced because projections are smoother than samples, and limited to that of white
    // samples in pixels of this size.
    double foldedTails(const Beside &beside, double whole) const {
        double roughness = 0.0;
        for (const auto &spread : m_fields.spreads)
            roughness = std::max(roughness, spread->roughness);
        const double stepMm = m_fields.lattice.shortestStepMm(),
                     white = std::min(1.0, 0.2 * std::pow(std::max(1.0, m_pixelMm / stepMm), 2.0)),
                     besideMargin = std::lerp(patternBesideMargin, pointBesideMargin, fewness());
        const auto tails = [&](double rough) {
            return tailMargin * rough * m_imageEnergy +
                   besideMargin * std::min(std::max(rough, projectedRoughness * roughness), white) *
                       beside.energy;
        };
        const double folded = (tails(m_sums.across) * m_blocks.tailsAcross +
                               tails(m_sums.down) * m_blocks.tailsDown) /
                              m_blocks.all;
        return std::max(folded, tailsOfLattice(whole));
    }

    // Tails of the lattice's own band cannot be told by what the picture has at the edge of its
    // own, which may be finer.
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

    // A linear cue reads depth by kernels of its own, which leave an error of their own: of a
    // picture without the cue, by how much depth a period is.
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
    glm::dvec2 m_windowMm, m_periodMm; ///< of the picture; of the slice grid's
    double m_coarseMm;                 ///< pixel of coarse planes
    PictureSums m_sums;
    double m_imageEnergy, m_centralImage, m_centralError;
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
