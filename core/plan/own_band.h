// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/fourier/spectrum.h"
#include "core/scene/image_definition.h"

namespace pellucid::plan {

/// The energy of a prepared field's spectrum: from above by blocks of cells, and of the low
/// frequencies of every view.
///
/// A view sees a plane of the spectrum. Its energy beyond a radius is the sum over the blocks that
/// the plane crosses of their area in the plane times the mean energy there. That mean is not more
/// than half the largest mean of 2 x 2 x 2 cells of the block, except by chance: a line of cells,
/// which a plane may contain, fills a quarter of those eight, and an eighth of the block's width.
/// The cells are those of the field divided by the kernel's apodisation, which has more energy than
/// the field itself.
class SpectrumEnergies {
public:
    /// *Throws* Cancelled, Error{outOfMemory}.
    SpectrumEnergies(const fourier::Spectrum &spectrum, const scene::ImageDefinition &image,
                     const task::Progress &progress = {});

    /// The energies of a view by frequency: entry n holds that of the ring from n to n + 1 times
    /// `ringPerMm`, from above, up to `limitPerMm`.
    /// *Shape*: `axes`: columns U, V and W. *Units*: of the spectrum squared, over mm^2.
    std::vector<double> rings(const glm::dmat3 &axes, double limitPerMm) const;
    /// The energy of the low frequencies of a view, less a margin: the whole view has more.
    /// *Units*: as `rings`.
    double least(const glm::dmat3 &axes) const;
    double ringPerMm() const { return m_ringPerMm; }
    /// Blocks are too coarse for frequencies below this.
    double lowPerMm() const { return m_lowPerMm; }

private:
    struct Blocks;
    std::shared_ptr<const Blocks> m_blocks;
    std::vector<float> m_low; ///< by direction, of three faces of a cube
    double m_ringPerMm = 1.0, m_lowPerMm = 0.0;
};

/// How far from frequency 0 a view of several fields has to be read, and what is left beyond.
class OwnBand {
public:
    using Weights = std::array<double, 3>; ///< of a field in red, green and blue

    /// `tolerance`: how much of a picture may be left out, relative L2.
    OwnBand(std::vector<std::shared_ptr<const SpectrumEnergies>> fields, double tolerance)
        : m_fields(std::move(fields)), m_tolerance(tolerance) {}

    struct Reach {
        double radiusPerMm = 0.0; ///< frequencies beyond are not read
        double left = 0.0;        ///< beyond it, at most, relative L2 of the picture
    };
    /// The reach of a view of band-limited pixels: at most `limitPerMm`, and less if the tolerance
    /// allows it. *Shape*: one weight for each field.
    Reach reach(const glm::dmat3 &axes, std::span<const Weights> weights, double limitPerMm) const;

    double tolerance() const { return m_tolerance; }

private:
    std::vector<std::shared_ptr<const SpectrumEnergies>> m_fields;
    double m_tolerance;
};

} // namespace pellucid::plan
