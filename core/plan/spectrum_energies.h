// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/fourier/kernels_by_width.h"
#include "core/scene/image_definition.h"
#include "core/task/progress.h"

namespace pellucid::plan {

/// A part of a plane in a spectrum: the points offset + column * perColumn + row * perRow.
/// *Units*: cells, by axis.
struct PlanePatch {
    std::array<double, 3> perColumn{}, perRow{};
    double columns = 0.0, rows = 0.0; ///< its size
    double firstColumn = 0.0, firstRow = 0.0;
    std::array<double, 3> offset{};

    /// Its center, and half its extent, along an axis.
    double middle(std::size_t d) const;
    double reach(std::size_t d) const;
};

/// The points that represent patches of one size, relative to their first column and row. *Units*:
/// cells. *Shape*: a whole number of vectors; only the first `count` points are used.
struct PatchPoints {
    static constexpr std::size_t vector = 16;
    /// Closer than blocks are long, from edge to edge and a little beyond: frequencies at the edge
    /// read cells there.
    explicit PatchPoints(const PlanePatch &patch);

    std::size_t count = 0;
    /// Whether patches are smaller than blocks, which say little of where in them the energy is:
    /// then the largest error of any point counts.
    bool isSmall = false;
    std::array<std::vector<float>, 3> cells;
    std::array<float, 3> reach{}; ///< from a point to the end of its part of the patch, by axis
};

/// How much error each width of kernel makes, and how much energy there is, anywhere in the
/// spectrum of a prepared field: by blocks of cells, and for the low frequencies of every view.
class SpectrumEnergies {
public:
    static constexpr std::size_t maxEntries = 8;
    /// By `entryOf(width)`.
    using Errors = std::array<float, maxEntries>;

    /// `tolerance`: the relative L2 error that a view may make; what is far below it is not
    /// measured. *Throws* Cancelled, Error{outOfMemory}.
    SpectrumEnergies(const fourier::Spectrum &spectrum, const fourier::KernelsByWidth &kernels,
                     const scene::ImageDefinition &image, double tolerance,
                     const task::Progress &progress = {});

    static std::size_t entryOf(int width);
    const volume::GridSize &padded() const;
    /// A bound on the energy of any frequency of the picture in a patch, in far less time.
    float energyBound(const PlanePatch &patch) const;
    /// The mean squared error of a frequency of the picture in a patch. *Units*: of the spectrum
    /// squared.
    Errors errorsIn(const PlanePatch &patch, const PatchPoints &points) const;
    /// The energy of the low frequencies of a view, less a margin: the whole view has more.
    /// *Shape*: `axes`: columns U, V and W. *Units*: of the spectrum squared, over mm^2.
    double minEnergy(const glm::dmat3 &axes) const;
    /// Blocks are too coarse for frequencies within so many cells of frequency 0 along each axis.
    static constexpr double lowCells = 12.0;

private:
    struct Blocks;
    double minEnergyOfAll() const; ///< of `minEnergy`
    std::shared_ptr<const Blocks> m_blocks;
    std::vector<float> m_low; ///< by direction, of three faces of a cube
};

} // namespace pellucid::plan
